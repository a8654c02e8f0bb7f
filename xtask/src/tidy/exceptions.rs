//! What may break a rule, and why: `exceptions.txt`, a line each.

use super::Finding;

const PATH: &str = "xtask/src/tidy/exceptions.txt";

struct Exception<'a> {
    rule: &'a str,
    /// A file, or a folder with all that is in it: it then ends in `/`.
    path: &'a str,
    /// The word, type or link; empty for any.
    what: &'a str,
}

/// The findings for which there is no exception, and exceptions for which there is no finding.
pub(super) fn without_excepted(findings: Vec<Finding>) -> Vec<Finding> {
    apply(findings, include_str!("exceptions.txt"))
}

/// The same by exceptions in `text`.
pub(super) fn apply(mut findings: Vec<Finding>, text: &str) -> Vec<Finding> {
    let mut own = Vec::new();
    for (index, line) in text.lines().enumerate() {
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let before = findings.len();
        let problem = match Exception::parse(line) {
            None => "write `rule | path | what | reason`",
            Some(exception) => {
                findings.retain(|finding| !exception.covers(finding));
                "nothing needs this exception any more: take it away"
            }
        };
        if findings.len() == before {
            own.push(of_line(index + 1, problem));
        }
    }
    findings.extend(own);
    findings
}

fn of_line(line: usize, message: &str) -> Finding {
    Finding {
        path: PATH.to_owned(),
        line,
        rule: "exceptions",
        what: String::new(),
        message: message.to_owned(),
    }
}

impl<'a> Exception<'a> {
    /// Without a reason it is none.
    fn parse(line: &'a str) -> Option<Exception<'a>> {
        let fields: Vec<&str> = line.split('|').map(str::trim).collect();
        let [rule, path, what, reason] = fields.try_into().ok()?;
        (!reason.is_empty()).then_some(Exception { rule, path, what })
    }

    fn covers(&self, finding: &Finding) -> bool {
        let is_there = if self.path.ends_with('/') {
            finding.path.starts_with(self.path)
        } else {
            finding.path == self.path
        };
        is_there && finding.rule == self.rule && (self.what.is_empty() || finding.what == self.what)
    }
}
