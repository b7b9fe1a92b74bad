//! Each target's corpus, and a campaign.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use verne_fuzz::{campaign, target};

macro_rules! campaigns {
    ($($name:ident)*) => { $(
        #[test]
        fn $name() {
            campaign::run(&target(stringify!($name)).unwrap());
        }
    )* };
}

campaigns! {
    apt body csv gcode headers keys machine mesh ndjson packed_program query settings solver store table_arrow table_csv
    table_ndjson workspaces
}
