//! The limit of open files. Every connection is an open file, and a process may usually open 1024.

use crate::process::server::connection_limit::PROBE_CONNECTIONS;

/// Files for jobs, results and everything else that is no connection.
const OTHER_FILES: u64 = 1024;

/// Raises the limit of open files for `connections`. Returns fewer connections, with a warning, if the system allows
/// too few files.
pub(crate) fn raise_for(connections: usize) -> usize {
    let others = OTHER_FILES + PROBE_CONNECTIONS as u64;
    let wanted = (connections as u64).saturating_add(others);
    let allowed = match rlimit::increase_nofile_limit(wanted) {
        Ok(allowed) => allowed,
        Err(error) => {
            tracing::warn!(%error, "cannot read the limit of open files");
            return connections;
        }
    };
    let possible = possible(allowed, others, connections);
    if possible < connections {
        tracing::warn!(
            allowed,
            wanted,
            connections = possible,
            "the limit of open files is too low for --max-connections, jobs and results, so the service accepts fewer \
             connections: raise the limit (ulimit -n), or lower --max-connections"
        );
    }
    possible
}

/// The connections that are possible besides other files; at least half of the files are for connections.
fn possible(allowed: u64, others: u64, connections: usize) -> usize {
    let left = allowed.saturating_sub(others).max(allowed / 2).max(1);
    connections.min(usize::try_from(left).unwrap_or(usize::MAX))
}

#[cfg(test)]
mod tests {
    use super::possible;

    #[test]
    fn connections_leave_files_for_other_uses() {
        assert_eq!(possible(20_000, 1_000, 10_000), 10_000);
        assert_eq!(possible(11_000, 1_000, 10_000), 10_000);
        assert_eq!(possible(4_096, 1_000, 10_000), 3_096);
        assert_eq!(possible(4_096, 1_000, 100), 100);
        assert_eq!(possible(1_024, 1_000, 10_000), 512);
        assert_eq!(possible(1, 1_000, 10_000), 1);
    }
}
