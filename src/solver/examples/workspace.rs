//! The workspace of a part: volume, surface, slice, membership and dexterity.
//!
//! `cargo run --release -p verne-solver --example workspace [TOLERANCE]`
//!
//! TOLERANCE in mm is the greatest distance between the surface and the true boundary; 5 mm without an argument. The
//! tool is 150 mm long and perpendicular to the table (phi1 = phi2 = 0: the paper's Fig. 8). It prints:
//!
//! - `volume`: by integration, with its error; `jacobian` is the range of the map's determinant (both signs: folded).
//! - `surface`: triangles, the volume they enclose, and which constraints bound the workspace (number of triangles).
//! - `slice`: area and outlines of the cut at Z = 300 mm over the table.
//! - `member`: whether a point belongs to the workspace, and the worst margin there.
//! - `phi1`: the inclinations that reach that point, degrees, with the constraint that ends each interval.

use std::collections::BTreeMap;
use std::error::Error;

use verne_solver::Machine;
use verne_solver::workspace::dexterity::{DexterityRequest, orientations};
use verne_solver::workspace::{Kind, Request, Unobserved, agree, contains, measure, slice, surface};

fn main() -> Result<(), Box<dyn Error>> {
    let machine = Machine::verne();
    let tolerance = std::env::args().nth(1).map_or(Ok(5.0), |number| number.parse())?;
    let request = Request { tool_length: 150.0, ..Request::new(Kind::Part, tolerance) };

    let measured = measure(&machine, &request, &Unobserved)?;
    println!("volume {:?} mm³, area {:.0} mm²", measured.volume, measured.area);
    println!("jacobian {:.3?}", measured.jacobian);

    let boundary = surface(&machine, &request, &Unobserved)?;
    agree(&measured, &boundary, tolerance, &Unobserved)?;
    let mut bound_by = BTreeMap::new();
    for binding in &boundary.bindings {
        *bound_by.entry(binding.constraint).or_insert(0) += 1;
    }
    println!("surface {} triangles, {:.5e} mm³, {bound_by:?}", boundary.triangles.len(), boundary.volume());

    let cut = slice(&machine, &request, 300.0, &[], &Unobserved)?;
    println!("slice {:.0} mm² in {} outlines", cut.area(), cut.polygons.len());

    let point = [100.0, 50.0, 300.0];
    for member in contains(&machine, &request, &[point], &Unobserved)? {
        println!("member {point:?} {} {:?}", member.inside, member.margin);
    }

    let phi1 = [-180_f64, 180.0].map(f64::to_radians);
    let question = DexterityRequest { tool_length: 150.0, ..DexterityRequest::new(phi1, 50.0) };
    for interval in orientations(&machine, point, &question)? {
        let ends = interval.bindings.map(|binding| binding.map(|binding| binding.constraint));
        println!("phi1 {:.4?}° ended by {ends:?}", interval.ends.map(f64::to_degrees));
    }
    Ok(())
}
