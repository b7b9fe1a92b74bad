//! The arguments of a command that answers one question, or with `--batch` each row of a file.

use clap::{ArgMatches, Args, Command, Error, FromArgMatches};

use crate::process::cli::answer_format::AnswerFormat;
use crate::process::cli::batch::{BatchCommand, BatchQuery};

/// The flag that decides.
const BATCH: &str = "batch";

/// One question.
#[derive(Debug, Args)]
pub(crate) struct OneCommand<Q: Args> {
    #[command(flatten)]
    pub query: Q,
    #[command(flatten)]
    pub format: AnswerFormat,
}

/// One question or a batch. Arguments that both have are defined by the question.
#[derive(Debug)]
pub(crate) enum OneOrBatch<One: Args, Rows: BatchQuery> {
    /// One question.
    One(OneCommand<One>),
    /// A batch.
    Batch(BatchCommand<Rows>),
}

impl<One: Args, Rows: BatchQuery> Args for OneOrBatch<One, Rows> {
    fn augment_args(command: Command) -> Command {
        let batch = BatchCommand::<Rows>::augment_args(Command::new(BATCH));
        let mut command = OneCommand::<One>::augment_args(command);
        let of_one: Vec<_> = command.get_arguments().map(|arg| arg.get_id().clone()).collect();
        let of_batch: Vec<_> = batch.get_arguments().map(|arg| arg.get_id().clone()).collect();
        let only_one: Vec<_> = of_one.iter().filter(|id| !of_batch.contains(id)).collect();
        for id in &only_one {
            command = command.mut_arg(id, |arg| arg.conflicts_with(BATCH));
        }
        for arg in batch.get_arguments().filter(|arg| !of_one.contains(arg.get_id())).cloned() {
            // A required argument of the question excuses a missing --batch, so `requires` is not enough.
            let arg = if *arg.get_id() == BATCH {
                arg.required(false)
            } else {
                arg.requires(BATCH).conflicts_with_all(only_one.iter().copied())
            };
            command = command.arg(arg.help_heading("Batches"));
        }
        command
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl<One: Args, Rows: BatchQuery> FromArgMatches for OneOrBatch<One, Rows> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        if matches.contains_id(BATCH) {
            BatchCommand::from_arg_matches(matches).map(Self::Batch)
        } else {
            OneCommand::from_arg_matches(matches).map(Self::One)
        }
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
