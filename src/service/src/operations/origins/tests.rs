//! Parts of a region.

use serde_json::json;
use verne_solver::workspace::Unobserved;

use super::{OriginsPart, compute_origins, compute_part, merge_parts, pack_extent, survey};
use crate::operations::machine_registry::MachineRegistry;
use crate::operations::origins_question::CheckedOrigins;
use crate::operations::toolpath_request::{ProgramSource, read_fields};
use crate::wire::origins::OriginsBody;
use crate::wire::parse::parse_body;

#[test]
fn many_workers_make_the_bytes_of_one() {
    let body = json!({"program": {"points": [[-60, -40, 0], [60, -40, 10], [60, 50, 0, 0.2, 0.15, 1]]},
        "tool_length": 100, "cell": 90});
    let request: OriginsBody = parse_body(body.to_string().as_bytes()).unwrap();
    let (checked, source) = read_fields(&request.toolpath, &MachineRegistry::default()).unwrap();
    let ProgramSource::Received(received) = &source else { panic!() };
    let question =
        CheckedOrigins::new(&request.more, &checked).unwrap().question(checked.question(source.id()));
    let whole = compute_origins(&question, &received.program, &Unobserved).unwrap();
    let surveyed = survey(&question, &received.program, None, &Unobserved).unwrap();
    let stored = pack_extent(&surveyed).unwrap();
    let slabs: Vec<_> = [2, 0, 1]
        .map(|number| {
            let surveyed = survey(&question, &received.program, Some(&stored), &Unobserved).unwrap();
            compute_part(&question, &surveyed, OriginsPart { number, count: 3 }, &Unobserved).unwrap()
        })
        .into();
    let merged = merge_parts(&question, &surveyed, &slabs, &Unobserved).unwrap();
    assert_eq!(whole.summary, merged.summary);
    assert_eq!(whole.mesh.positions(), merged.mesh.positions());
    assert_eq!(whole.mesh.triangles(), merged.mesh.triangles());
    assert!(!whole.mesh.triangles().is_empty());
}
