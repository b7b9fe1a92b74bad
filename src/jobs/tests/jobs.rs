//! Jobs as their callers see them: the contract that every back end keeps, and what only one of them promises.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

#[path = "contract/claims.rs"]
mod claims;
#[path = "contract/ends.rs"]
mod ends;
#[path = "contract/lists.rs"]
mod lists;
#[path = "contract/order.rs"]
mod order;
#[path = "contract/parts.rs"]
mod parts;
#[path = "contract/seats.rs"]
mod seats;
#[path = "contract/watching.rs"]
mod watching;

#[path = "embedded/backup.rs"]
mod backup;
#[path = "embedded/closing.rs"]
mod closing;
#[path = "embedded/damage.rs"]
mod damage;
#[path = "embedded/killed.rs"]
mod killed;
#[path = "embedded/lanes.rs"]
mod lanes;
#[path = "embedded/parts_restart.rs"]
mod parts_restart;
#[path = "embedded/restart.rs"]
mod restart;

#[path = "jetstream/access.rs"]
mod access;
#[path = "jetstream/denials.rs"]
mod denials;
#[path = "jetstream/losses.rs"]
mod losses;
#[path = "jetstream/nodes.rs"]
mod nodes;
#[path = "jetstream/turnover.rs"]
mod turnover;

#[path = "support/broker.rs"]
mod broker;
#[path = "support/child.rs"]
mod child;
#[path = "support/stage.rs"]
mod stage;
#[path = "support/stand.rs"]
mod stand;
