//! Writes solids in every format into a directory, with what a reader should find in them, and a path:
//! `cargo run --release -p verne-mesh --example solids -- DIR`

#[path = "../tests/support/paths.rs"]
mod paths;
#[path = "../tests/support/solids.rs"]
mod solids;

use std::error::Error;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde_json::json;
use solids::SolidBuilder;
use verne_mesh::glb::{Options, Up};
use verne_mesh::{Mesh, glb, ply, stl};

fn main() -> Result<(), Box<dyn Error>> {
    let directory = PathBuf::from(std::env::args().nth(1).ok_or("the directory is missing")?);
    std::fs::create_dir_all(&directory)?;
    let two = SolidBuilder::default().block([-400.0, -500.0, 900.0], [0.0, 500.0, 1600.0], false);
    let solids = [
        ("sphere", SolidBuilder::default().ball([10.0, -20.0, 1250.0], 400.0, 79).mesh()),
        ("box", solids::block()),
        ("two", two.ball([300.0, 0.0, 1200.0], 200.0, 30).mesh()),
        ("ring", SolidBuilder::default().ring(300.0, 100.0, 40).mesh()),
        ("empty", solids::empty()),
        ("million", SolidBuilder::default().ball([0.0, 0.0, 1250.0], 500.0, 354).mesh()),
    ];
    for (name, mesh) in solids {
        write(&directory.join(name), &mesh)?;
    }
    let options = Options { name: "path".to_owned(), up: Up::PositiveZ, extras: json!({ "unit": "mm" }) };
    glb::write_path(&paths::square(100), &options, File::create(directory.join("path.glb"))?)?;
    Ok(())
}

fn write(path: &Path, mesh: &Mesh) -> Result<(), Box<dyn Error>> {
    let extras = json!({ "unit": "mm", "volume": mesh.volume(), "triangles": mesh.triangles().len() });
    let options = Options { name: "solid".to_owned(), up: Up::NegativeZ, extras: extras.clone() };
    let file = |extension: &str| File::create(path.with_extension(extension));
    let glb = timed(|| glb::write(mesh, 40_f64.to_radians(), &options, file("glb")?))?;
    let stl = timed(|| stl::write(mesh, "solid", file("stl")?))?;
    let ply = timed(|| ply::write(mesh, &extras.to_string(), file("ply")?))?;
    let json = timed(|| verne_mesh::json::write(mesh, &extras, file("json")?))?;
    let audit = timed(|| {
        println!("{} {:?}", path.display(), mesh.audit());
        Ok(())
    })?;
    println!("  glb {glb:.1?} stl {stl:.1?} ply {ply:.1?} json {json:.1?} audit {audit:.1?}");
    Ok(())
}

fn timed(work: impl FnOnce() -> io::Result<()>) -> io::Result<Duration> {
    let begun = Instant::now();
    work()?;
    Ok(begun.elapsed())
}
