//! Tests of the public interface: what every back end does, and what only one of them does.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

#[path = "contract/claims.rs"]
mod claims;
#[path = "contract/lists.rs"]
mod lists;
#[path = "contract/order.rs"]
mod order;
#[path = "contract/outcomes.rs"]
mod outcomes;
#[path = "contract/slots.rs"]
mod slots;
#[path = "contract/subtasks.rs"]
mod subtasks;
#[path = "contract/watchers.rs"]
mod watchers;

#[path = "embedded/backup.rs"]
mod backup;
#[path = "embedded/crashes.rs"]
mod crashes;
#[path = "embedded/damaged_database.rs"]
mod damaged_database;
#[path = "embedded/draining.rs"]
mod draining;
#[path = "embedded/restart.rs"]
mod restart;
#[path = "embedded/settings.rs"]
mod settings;
#[path = "embedded/subtasks_restart.rs"]
mod subtasks_restart;

#[path = "jetstream/authentication.rs"]
mod authentication;
#[path = "jetstream/lost_processes.rs"]
mod lost_processes;
#[path = "jetstream/many_processes.rs"]
mod many_processes;
#[path = "jetstream/permissions.rs"]
mod permissions;
#[path = "jetstream/restarts.rs"]
mod restarts;

#[path = "support/broker.rs"]
mod broker;
#[path = "support/child_process.rs"]
mod child_process;
#[path = "support/fixture.rs"]
mod fixture;
#[path = "support/scripted_work.rs"]
mod scripted_work;
