//! Progress bars, notes and lines on the terminal. All that the command prints goes through here,
//! with what is not safe to print shown as codes; only [`thumbnail`](super::thumbnail) draws by itself.

use super::printable;
use crate::error::Error;
use crate::estimate_args::OutputArgs;
use crate::fit::Stream;
use crate::lines::indented;
use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use radiosity::{Observer, Stage};
use serde::Serialize;
use std::io::{self, ErrorKind, Write};
use std::sync::Mutex;

/// Prints a line on standard output.
pub(crate) fn say(text: &str) -> Result<(), Error> {
    print(&Stream::Output.fit(&printable::line(text))).map_err(unprintable)
}

/// Prints a JSON object on a line of standard output.
pub(crate) fn say_json(object: &impl Serialize) -> Result<(), Error> {
    let text = serde_json::to_string(object).expect("plain data always encodes");
    print(&printable::json(&text)).map_err(unprintable)
}

/// Prints lines on standard error, whether anybody reads them or not.
pub(crate) fn tell(text: &str) {
    let text = Stream::Error.fit(&printable::lines(text));
    let _ = writeln!(io::stderr(), "{text}");
}

/// That nobody reads standard output any more (`| head`) is no error.
fn print(text: &str) -> io::Result<()> {
    match writeln!(io::stdout(), "{text}") {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

fn unprintable(error: io::Error) -> Error {
    let path = "standard output".into();
    Error::Output { path, error }
}

/// Shows progress on standard error if that is a terminal, and prints lines.
pub(crate) struct Terminal {
    bar: Mutex<Option<ProgressBar>>,
    /// Why the first line that could not be printed was not.
    failure: Mutex<Option<io::Error>>,
    /// Whether lines for people go to standard error, to leave standard output to JSON.
    pub(crate) json: bool,
    /// Whether people want to know more.
    pub(crate) is_verbose: bool,
}

impl Terminal {
    /// For commands that have no more to say than they do.
    pub(crate) fn brief(json: bool) -> Terminal {
        Terminal::new(OutputArgs {
            json,
            verbose: false,
        })
    }

    pub(crate) fn new(args: OutputArgs) -> Terminal {
        Terminal {
            bar: Mutex::new(None),
            failure: Mutex::new(None),
            json: args.json,
            is_verbose: args.verbose,
        }
    }

    /// Changes what the bar says, and how much work there is.
    pub(crate) fn update(&self, message: String, work: u64) {
        if let Some(bar) = &*self.bar() {
            bar.set_message(message);
            bar.set_length(work);
        }
    }

    /// One line of the report for people. A failure is no reason to lose the run:
    /// [`finish`](Self::finish) tells it.
    pub(crate) fn line(&self, text: &str) {
        let text = printable::line(text);
        if self.json {
            let _ = writeln!(io::stderr(), "{}", Stream::Error.fit(&text));
        } else if let Err(error) = print(&Stream::Output.fit(&text)) {
            self.failure().get_or_insert(error);
        }
    }

    /// A line for those who want to know more.
    pub(crate) fn detail(&self, text: &str) {
        if self.is_verbose {
            self.line(text);
        }
    }

    /// Whether all lines were printed.
    pub(crate) fn finish(&self) -> Result<(), Error> {
        self.failure()
            .take()
            .map_or(Ok(()), |error| Err(unprintable(error)))
    }

    fn failure(&self) -> std::sync::MutexGuard<'_, Option<io::Error>> {
        self.failure
            .lock()
            .expect("nothing panics while it holds an error")
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
        let text = Stream::Error.fit(&printable::line(&indented(message)));
        let print = || {
            let _ = writeln!(io::stderr(), "{text}");
        };
        match &*self.bar() {
            Some(bar) => bar.suspend(print),
            None => print(),
        }
    }
}
