//! Builds the viewer with npm into OUT_DIR, where the crate embeds it from.
//!
//! Without Node the service is built all the same, and says at `/` how to get the viewer. Cargo does not notice when Node
//! is installed then: a script that ran at every build until it is would link the binary anew every time.
//! `VERNE_VIEWER=require` makes a viewer that cannot be built an error; `VERNE_VIEWER=skip` does not try.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// What the viewer is made from, seen from its directory. Not `generated` or `node_modules`, which the build writes.
const SOURCES: [&str; 6] =
    ["src", "index.html", "package.json", "package-lock.json", "tsconfig.json", "vite.config.ts"];

fn main() -> Result<(), String> {
    // Asked when the script runs: a checkout may have moved, with all that was built in it, since the script was compiled.
    let crate_directory = env::var("CARGO_MANIFEST_DIR").map_err(|error| error.to_string())?;
    let viewer = Path::new(&crate_directory).join("../viewer");
    for source in SOURCES {
        println!("cargo::rerun-if-changed={}", viewer.join(source).display());
    }
    println!("cargo::rerun-if-changed={}", viewer.join("../../openapi/openapi.json").display());
    println!("cargo::rerun-if-env-changed=VERNE_VIEWER");

    let out = PathBuf::from(env::var("OUT_DIR").map_err(|error| error.to_string())?).join("viewer");
    empty(&out)?;
    let wish = env::var("VERNE_VIEWER").unwrap_or_default();
    if wish == "skip" {
        return Ok(());
    }
    match build(&viewer, &out) {
        Err(fault) if wish == "require" => Err(format!("the viewer cannot be built: {fault}")),
        Err(fault) => {
            empty(&out)?;
            println!("cargo::warning=built without the viewer: {fault}");
            Ok(())
        }
        Ok(()) => Ok(()),
    }
}

fn empty(directory: &Path) -> Result<(), String> {
    // It may not be there yet.
    let _ = fs::remove_dir_all(directory);
    fs::create_dir_all(directory).map_err(|error| format!("{}: {error}", directory.display()))
}

fn build(viewer: &Path, out: &Path) -> Result<(), String> {
    if !installed(viewer) {
        npm(viewer, &["ci", "--no-audit", "--no-fund"])?;
    }
    let out = out.to_string_lossy();
    npm(viewer, &["run", "build", "--", "--outDir", &out, "--emptyOutDir"])
}

/// Whether `node_modules` holds what the lock file asks for.
fn installed(viewer: &Path) -> bool {
    let time = |path: &str| fs::metadata(viewer.join(path)).and_then(|file| file.modified());
    match (time("node_modules/.package-lock.json"), time("package-lock.json")) {
        (Ok(installed), Ok(asked)) => installed >= asked,
        _ => false,
    }
}

fn npm(viewer: &Path, arguments: &[&str]) -> Result<(), String> {
    let program = if cfg!(windows) { "npm.cmd" } else { "npm" };
    let output = Command::new(program)
        .args(arguments)
        .current_dir(viewer)
        .output()
        .map_err(|error| format!("npm does not start ({error})"))?;
    if output.status.success() {
        return Ok(());
    }
    // Cargo shows what a failing build script printed; type errors go to the standard output.
    eprint!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    Err(format!("npm {} failed", arguments.join(" ")))
}
