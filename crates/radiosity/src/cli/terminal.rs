//! Progress bars, notes and lines on the terminal.

use crate::error::Error;
use crate::observer::{Observer, Stage};
use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use std::io::{ErrorKind, Write};
use std::sync::Mutex;

/// Prints a line on standard output. That nobody reads it any more (`| head`) is no error.
pub(crate) fn say(text: &str) -> Result<(), Error> {
    match writeln!(std::io::stdout(), "{text}") {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Error::Output {
            path: "standard output".into(),
            error,
        }),
        _ => Ok(()),
    }
}

/// Prints a line on standard error, whether anybody reads it or not.
pub(crate) fn tell(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Shows progress on standard error if that is a terminal, and prints lines.
pub(crate) struct Terminal {
    bar: Mutex<Option<ProgressBar>>,
    /// Whether lines for people go to standard error, to leave standard output to JSON.
    pub(crate) json: bool,
}

impl Terminal {
    pub(crate) fn new(json: bool) -> Terminal {
        Terminal {
            bar: Mutex::new(None),
            json,
        }
    }

    /// Changes what the bar says, and how much work there is.
    pub(crate) fn update(&self, message: String, work: u64) {
        if let Some(bar) = &*self.bar() {
            bar.set_message(message);
            bar.set_length(work);
        }
    }

    /// One line of the report for people.
    pub(crate) fn line(&self, text: &str) {
        // A closed pipe (`| head`) is no reason to lose the run.
        let _ = if self.json {
            writeln!(std::io::stderr(), "{text}")
        } else {
            writeln!(std::io::stdout(), "{text}")
        };
    }

    fn bar(&self) -> std::sync::MutexGuard<'_, Option<ProgressBar>> {
        self.bar
            .lock()
            .expect("nothing panics while it holds a bar")
    }
}

impl Observer for Terminal {
    fn begin(&self, stage: Stage, work: u64) {
        let (name, counts) = match stage {
            Stage::FormFactors => ("form factors", "{human_pos} of {human_len} pairs  {rate}  "),
            Stage::Solve => ("solution", ""),
            Stage::Reference => ("reference", "{msg}  "),
            Stage::Display => ("pictures", "{human_pos} of {human_len} rows  {rate}  "),
        };
        let template = format!("{name:<14}{{bar:30}} {{percent:>3}} %  {counts}{{eta}} left");
        let rate = |state: &ProgressState, text: &mut dyn std::fmt::Write| {
            let _ = write!(text, "{}/s", HumanCount(state.per_sec() as u64));
        };
        let style = ProgressStyle::with_template(&template)
            .expect("the template is well-formed")
            .with_key("rate", rate);
        // Draws on standard error, and nothing at all where that is no terminal.
        *self.bar() = Some(ProgressBar::new(work).with_style(style));
    }

    fn advance(&self, done: u64) {
        if let Some(bar) = &*self.bar() {
            bar.inc(done);
        }
    }

    fn end(&self) {
        if let Some(bar) = self.bar().take() {
            bar.finish_and_clear();
        }
    }

    fn note(&self, message: &str) {
        let print = || {
            let _ = writeln!(std::io::stderr(), "{:<14}{message}", "");
        };
        match &*self.bar() {
            Some(bar) => bar.suspend(print),
            None => print(),
        }
    }
}
