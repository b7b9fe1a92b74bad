//! Every connection is an open file, and a process may usually open 1024.

use crate::process::server::connection_limit::SPARE;

/// Files beside the connections: jobs, results, and what is read in passing.
const OTHERS: u64 = 1024;

/// Asks the system for as many files as so many connections may need. How many there may be: fewer where it gives fewer
/// files, and it is warned of.
pub(crate) fn room_for(connections: usize) -> usize {
    let others = OTHERS + u64::try_from(SPARE).unwrap_or(u64::MAX);
    let wanted = u64::try_from(connections).unwrap_or(u64::MAX).saturating_add(others);
    let allowed = match rlimit::increase_nofile_limit(wanted) {
        Ok(allowed) => allowed,
        Err(error) => {
            tracing::warn!(%error, "cannot read the limit of open files");
            return connections;
        }
    };
    let room = within(allowed, others, connections);
    if room < connections {
        tracing::warn!(
            allowed,
            wanted,
            connections = room,
            "the limit of open files is too low for --max-connections, jobs and results, so the service accepts fewer \
             connections: raise the limit (ulimit -n), or lower --max-connections"
        );
    }
    room
}

/// So many connections, or what others leave of the files; where others would leave little, half.
fn within(allowed: u64, others: u64, connections: usize) -> usize {
    let left = allowed.saturating_sub(others).max(allowed / 2).max(1);
    connections.min(usize::try_from(left).unwrap_or(usize::MAX))
}

#[cfg(test)]
mod tests {
    use super::within;

    #[test]
    fn connections_leave_files_to_others() {
        assert_eq!(within(20_000, 1_000, 10_000), 10_000);
        assert_eq!(within(11_000, 1_000, 10_000), 10_000);
        assert_eq!(within(4_096, 1_000, 10_000), 3_096);
        assert_eq!(within(4_096, 1_000, 100), 100);
        assert_eq!(within(1_024, 1_000, 10_000), 512);
        assert_eq!(within(1, 1_000, 10_000), 1);
    }
}
