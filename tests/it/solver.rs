//! The solver against the reference sets, the oracle and the laws of the machine.
