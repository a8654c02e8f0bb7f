//! The command, as people call it.

mod cache;
mod command;
mod compare;
mod covers;
mod darkness;
mod display;
mod export;
mod failures;
mod inspect;
mod interruption;
mod lights;
mod place;
mod reference;
mod terminal;
