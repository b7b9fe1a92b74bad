//! Preimages and windings of whole programs.
