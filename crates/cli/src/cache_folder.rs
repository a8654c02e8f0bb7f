//! `cache list` and `cache clean`.

use super::cache_args::{CacheAction, CacheCommand};
use super::folders::Folders;
use super::printable;
use super::terminal::say;
use crate::error::Error;
use radiosity::cache::{Amount, Cleaned, Entry, Limits, Miss, Store};
use radiosity::words::{bytes, counted};

const FILES: [&str; 2] = ["file", "files"];

pub(crate) fn run(command: &CacheCommand, folders: &Folders) -> Result<(), Error> {
    let folder = command.folder.as_ref().unwrap_or(&folders.cache);
    let store = Store::new(folder);
    match command.action {
        CacheAction::List => list(&store),
        CacheAction::Clean(args) => clean(
            &store,
            Limits {
                age: args.older,
                bytes: args.keep,
            },
        ),
    }
}

fn list(store: &Store) -> Result<(), Error> {
    let entries = store.list().map_err(Error::CacheFolder)?;
    for entry in &entries {
        say(&describe(entry))?;
    }
    let all = amount(Amount {
        files: entries.len(),
        bytes: entries.iter().map(|entry| entry.bytes).sum(),
    });
    say(&format!("{all} in {}", store.folder().display()))
}

fn describe(entry: &Entry) -> String {
    let stage = match &entry.stage {
        Ok(stage) => stage.clone(),
        Err(Miss::Unfinished) => "unfinished".to_owned(),
        Err(miss) => format!("unusable: {miss}"),
    };
    let age = entry.last_use.and_then(|time| time.elapsed().ok());
    let age = age.map_or(String::new(), |age| match age.as_secs() {
        s if s < 60 => "just now".to_owned(),
        s if s < 3600 => format!("{} min ago", s / 60),
        s if s < 86_400 => format!("{} h ago", s / 3600),
        s => format!("{} days ago", s / 86_400),
    });
    let name = entry.path.file_name().unwrap_or_default().to_string_lossy();
    let scene = entry
        .scene
        .as_deref()
        .map_or(String::new(), printable::name);
    let size = bytes(entry.bytes);
    let line = format!("{stage:<14}{size:>8}  {age:<12}{name:<34}  {scene}");
    line.trim_end().to_owned()
}

fn clean(store: &Store, limits: Limits) -> Result<(), Error> {
    let cleaned = store.clean(limits).map_err(Error::CacheFolder)?;
    let (removed, folder) = (amount(cleaned.removed), store.folder().display());
    say(&format!("removed {removed} from {folder}"))?;
    say(&left_line(&cleaned))
}

fn left_line(cleaned: &Cleaned) -> String {
    let left = amount(cleaned.left);
    match cleaned.in_use {
        Amount { files: 0, .. } => format!("left: {left}"),
        in_use => format!(
            "left: {left}, of which another process is making {}",
            amount(in_use)
        ),
    }
}

fn amount(amount: Amount) -> String {
    let size = bytes(amount.bytes);
    format!("{} ({size})", counted(amount.files, FILES))
}
