//! Builds the viewer with npm and the guide with mdBook into `OUT_DIR`, from where the crate embeds them, and passes the
//! target on to the crate.
//!
//! Without Node the build succeeds, and the service explains at `/` how to get the viewer. Cargo does not run this
//! script again when Node is installed later: a script that runs at every build would link the binary at every build.
//! With `VERNE_VIEWER=require` a viewer that cannot be built is an error; with `VERNE_VIEWER=skip` the script does not
//! build it. With `VERNE_GUIDE=skip` it does not build the guide, and changes in `docs` do not link the binary anew.

#[path = "build/guide.rs"]
mod guide;
#[path = "build/guide_links.rs"]
mod guide_links;
#[path = "build/guide_reference.rs"]
mod guide_reference;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// The sources of the viewer, and of the client that it uses. The build writes `node_modules`, `generated` and `dist`
/// beside them.
const SOURCES: [&str; 11] = [
    "viewer/src",
    "../docs/frames.svg",
    "viewer/index.html",
    "viewer/package.json",
    "viewer/package-lock.json",
    "viewer/tsconfig.json",
    "viewer/vite.config.ts",
    "../clients/typescript/src",
    "../clients/typescript/package.json",
    "../clients/typescript/package-lock.json",
    "../clients/typescript/tsconfig.json",
];

/// The sources of the guide, beside the OpenAPI document: the chapters, and files that are chapters where they stand.
const GUIDE_SOURCES: [&str; 7] = [
    "../docs",
    "../clients/python/README.md",
    "../clients/typescript/README.md",
    "../docker/README.md",
    "../examples/README.md",
    "solver/src/kinematics.md",
    "solver/src/workspace/derivation.md",
];

fn main() -> Result<(), String> {
    // Cargo tells it to this script alone.
    println!("cargo::rustc-env=VERNE_TARGET={}", env::var("TARGET").map_err(|error| error.to_string())?);
    // Read when the script runs: the checkout may have moved since the script was compiled.
    let crate_directory = env::var("CARGO_MANIFEST_DIR").map_err(|error| error.to_string())?;
    let crates = Path::new(&crate_directory).join("..");
    for source in SOURCES {
        println!("cargo::rerun-if-changed={}", crates.join(source).display());
    }
    println!("cargo::rerun-if-changed={}", crates.join("../openapi/openapi.json").display());
    println!("cargo::rerun-if-env-changed=VERNE_VIEWER");
    println!("cargo::rerun-if-env-changed=VERNE_GUIDE");

    let out = PathBuf::from(env::var("OUT_DIR").map_err(|error| error.to_string())?);
    build_guide(&crates, &out.join("guide"))?;
    build_viewer(&crates, &out.join("viewer"))
}

fn build_guide(crates: &Path, out: &Path) -> Result<(), String> {
    empty(out)?;
    // A package of this crate alone has no `docs`.
    let docs = crates.join("../docs/book.toml");
    if env::var("VERNE_GUIDE").is_ok_and(|mode| mode == "skip") || !docs.exists() {
        return Ok(());
    }
    for source in GUIDE_SOURCES {
        println!("cargo::rerun-if-changed={}", crates.join(source).display());
    }
    guide::build(&crates.join(".."), out).map_err(|error| format!("the guide cannot be built: {error}"))
}

fn build_viewer(crates: &Path, out: &Path) -> Result<(), String> {
    empty(out)?;
    let mode = env::var("VERNE_VIEWER").unwrap_or_default();
    if mode == "skip" {
        return Ok(());
    }
    match build(crates, out) {
        Err(error) if mode == "require" => Err(format!("the viewer cannot be built: {error}")),
        Err(error) => {
            empty(out)?;
            println!("cargo::warning=built without the viewer: {error}");
            Ok(())
        }
        Ok(()) => Ok(()),
    }
}

fn empty(directory: &Path) -> Result<(), String> {
    // The directory may not exist yet.
    let _ = fs::remove_dir_all(directory);
    fs::create_dir_all(directory).map_err(|error| format!("{}: {error}", directory.display()))
}

fn build(crates: &Path, out: &Path) -> Result<(), String> {
    let viewer = crates.join("viewer");
    for package in [&crates.join("../clients/typescript"), &viewer] {
        if !installed(package) {
            npm(package, &["ci", "--no-audit", "--no-fund"])?;
        }
    }
    let out = out.to_string_lossy();
    npm(&viewer, &["run", "build", "--", "--outDir", &out, "--emptyOutDir"])
}

/// Whether `node_modules` is as new as the lock file.
fn installed(package: &Path) -> bool {
    let time = |path: &str| fs::metadata(package.join(path)).and_then(|file| file.modified());
    match (time("node_modules/.package-lock.json"), time("package-lock.json")) {
        (Ok(installed), Ok(locked)) => installed >= locked,
        _ => false,
    }
}

fn npm(package: &Path, arguments: &[&str]) -> Result<(), String> {
    let program = if cfg!(windows) { "npm.cmd" } else { "npm" };
    let output = Command::new(program)
        .args(arguments)
        .current_dir(package)
        .output()
        .map_err(|error| format!("npm does not start ({error})"))?;
    if output.status.success() {
        return Ok(());
    }
    // Cargo shows the output of a build script that fails. npm writes type errors to standard output.
    eprint!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    Err(format!("npm {} failed", arguments.join(" ")))
}
