use verne_solver::Machine;
use verne_solver::atlas::*;
use verne_solver::workspace::Unobserved;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let machine = if args.get(2).map(String::as_str) == Some("delta") {
        Machine::linear_delta()
    } else {
        Machine::verne()
    };
    let space = if args[1] == "platform" { Space::Platform } else { Space::Joints };
    let window = args.get(3).map(|h| {
        let h: f64 = h.parse().unwrap();
        Window { u: [-h, h], v: [-h, h] }
    });
    let request = AtlasRequest::new(&machine, space, window);
    let t = std::time::Instant::now();
    let a = atlas(&machine, &request, &Unobserved);
    let d = t.elapsed();
    match a {
        Err(e) => println!("{e:?} {d:?}"),
        Ok(a) => {
            eprintln!(
                "{d:?} curves {} nodes {} points {} regions {} checked {}",
                a.curves.len(),
                a.curves.iter().map(|c| c.points.len()).sum::<usize>(),
                a.points.len(),
                a.regions.len(),
                a.checked_points
            );
            for r in &a.regions {
                eprintln!(
                    "  n={} area={} err={} corners={} holes={} label={:?}",
                    r.solutions,
                    r.face.area,
                    r.face.area_error,
                    r.face.outer.len(),
                    r.face.holes.len(),
                    r.face.label
                );
            }
            let total: f64 = a.regions.iter().map(|r| r.face.area).sum();
            eprintln!(
                "total {total} window {}",
                (request.window.u[1] - request.window.u[0]) * (request.window.v[1] - request.window.v[0])
            );
            for r in &a.working {
                eprintln!(
                    "  working area={} err={} corners={} label={:?}",
                    r.area,
                    r.area_error,
                    r.outer.len(),
                    r.label
                );
            }
            for p in &a.points {
                eprintln!("  {:?}", p);
            }
            for c in &a.curves {
                println!(
                    "C {:?} {} {}",
                    c.kind,
                    c.closed,
                    c.points.iter().map(|p| format!("{},{}", p[0], p[1])).collect::<Vec<_>>().join(" ")
                );
            }
            for r in &a.regions {
                println!("R {} {} {}", r.solutions, r.face.label[0], r.face.label[1]);
            }
            for r in &a.working {
                println!(
                    "W {}",
                    r.outer.iter().map(|p| format!("{},{}", p[0], p[1])).collect::<Vec<_>>().join(" ")
                );
            }
            for p in &a.points {
                println!("P {:?} {} {}", p.kind, p.at[0], p.at[1]);
            }
        }
    }
}
