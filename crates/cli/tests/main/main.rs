//! The command, as people call it.

mod cache;
mod check;
mod command;
mod compare;
mod compare_memory;
mod covers;
mod darkness;
mod display;
mod docs;
mod export;
mod failures;
mod formats;
mod inspect;
mod interruption;
mod light_tables;
mod lights;
mod messages;
mod place;
mod plots;
mod reference;
mod room;
mod tables;
mod terminal;
