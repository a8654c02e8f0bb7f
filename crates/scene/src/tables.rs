//! What a scene file says that is no part of the scene: parameters of later stages, in tables of
//! their own and in keys of surfaces.

use crate::error::SceneError;
use crate::file::TABLES;
use crate::source::{Complaint, Source};
use crate::surface::KEYS;
use crate::toml_error::error_of;
use radiosity_params::{OutOfRange, Parameters};
use serde::de::IntoDeserializer;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

/// Tables that every scene has.
const REQUIRED: [&str; 2] = ["materials", "surfaces"];
/// Names that are alike to this degree may be meant for each other.
const NEAR: f64 = 0.9;

/// Tables and keys that are no part of the scene, to be taken one after the other.
pub struct Tables<'t> {
    source: Source<'t>,
    tables: DeTable<'t>,
    /// Names of those that were asked for.
    known: Vec<&'static str>,
    /// The name of each surface that has such keys, and these.
    of_surfaces: Vec<(String, DeTable<'t>)>,
}

impl<'t> Tables<'t> {
    pub(crate) fn none(source: Source<'t>) -> Tables<'t> {
        Tables {
            source,
            tables: DeTable::new(),
            known: Vec::new(),
            of_surfaces: Vec::new(),
        }
    }

    /// The tables of the scene, and the others.
    pub(crate) fn split(
        source: Source<'t>,
        mut document: Spanned<DeTable<'t>>,
        of_scene: &[&str],
    ) -> (Spanned<DeTable<'t>>, Tables<'t>) {
        let mut others = Tables {
            tables: without(document.get_mut(), of_scene),
            ..Tables::none(source)
        };
        if let Some(surfaces) = document.get_mut().get_mut("surfaces")
            && let DeValue::Array(surfaces) = surfaces.get_mut()
        {
            for surface in surfaces.iter_mut() {
                let DeValue::Table(table) = surface.get_mut() else {
                    continue;
                };
                let keys = without(table, &KEYS);
                let name = table.get("name").and_then(|name| name.get_ref().as_str());
                if !keys.is_empty() {
                    let name = name.unwrap_or_default().to_owned();
                    others.of_surfaces.push((name, keys));
                }
            }
        }
        (document, others)
    }

    /// Has a key of a table that was renamed read by its new name; says whether it was there. Where
    /// both names are, the old one stays, and is refused like any other that is not known.
    pub fn rename(&mut self, table: &str, old: &str, new: &'static str) -> bool {
        let Some(DeValue::Table(table)) = self.tables.get_mut(table).map(Spanned::get_mut) else {
            return false;
        };
        if table.contains_key(new) {
            return false;
        }
        let Some((key, value)) = table.remove_entry(old) else {
            return false;
        };
        table.insert(Spanned::new(key.span(), DeString::Borrowed(new)), value);
        true
    }

    /// The parameters in a table; what it does not say has defaults.
    pub fn take<P: Parameters>(&mut self, table: &'static str) -> Result<P, SceneError> {
        self.known.push(table);
        match self.tables.remove(table) {
            Some(value) if !value.get_ref().is_table() => {
                let complaint = Complaint::new(
                    format!("`{table}` is no table"),
                    format!("write [{table}], and keys below it"),
                );
                Err(self.source.error(value.span(), &complaint))
            }
            Some(value) => params(&self.source, value, P::check),
            None => Ok(P::default()),
        }
    }

    /// The parameters in keys of surfaces, with the names of those that have any. `check` is told
    /// the name and refuses what does not suit the surface.
    pub fn take_of_surfaces<P: Parameters>(
        &mut self,
        keys: &[&str],
        check: impl Fn(&str, &P) -> Result<(), OutOfRange>,
    ) -> Result<Vec<(String, P)>, SceneError> {
        let source = &self.source;
        let known = || KEYS.iter().chain(keys).copied();
        let read = |(name, table): (String, DeTable<'t>)| {
            if let Some(key) = unknown(&table, keys) {
                return Err(source.error(key.span(), &no_such("key", key.get_ref(), known())));
            }
            let start = table.keys().map(|key| key.span().start).min();
            let start = start.unwrap_or_default();
            let value = Spanned::new(start..start + 1, DeValue::Table(table));
            let params = params(source, value, |own: &P| {
                own.check().and_then(|()| check(&name, own))
            })?;
            Ok((name, params))
        };
        std::mem::take(&mut self.of_surfaces)
            .into_iter()
            .map(read)
            .collect()
    }

    /// A table whose name is nearly that of one that the scene must have and has not.
    pub(crate) fn mistyped(&self, scene: &DeTable<'t>) -> Option<SceneError> {
        let missing = REQUIRED.iter().filter(|name| !scene.contains_key(**name));
        let is_near = |name: &str, key: &str| strsim::jaro_winkler(name, key) > NEAR;
        let found = missing.flat_map(|name| {
            let keys = self.tables.keys();
            keys.filter(move |key| is_near(name, key.get_ref()))
        });
        let key = found.min_by_key(|key| key.span().start)?;
        let complaint = no_such("table", key.get_ref(), TABLES.iter().copied());
        Some(self.source.error(key.span(), &complaint))
    }

    /// Refuses tables and keys that nobody has taken.
    pub fn finish(self) -> Result<(), SceneError> {
        let mut keys = self.of_surfaces.iter();
        if let Some(key) = keys.find_map(|(_, table)| unknown(table, &[])) {
            let complaint = no_such("key", key.get_ref(), KEYS.iter().copied());
            return Err(self.source.error(key.span(), &complaint));
        }
        let known = || TABLES.iter().chain(&self.known).copied();
        match unknown(&self.tables, &[]) {
            Some(table) => {
                let complaint = no_such("table", table.get_ref(), known());
                Err(self.source.error(table.span(), &complaint))
            }
            None => Ok(()),
        }
    }
}

/// Takes all entries but these out of a table.
fn without<'t>(table: &mut DeTable<'t>, keys: &[&str]) -> DeTable<'t> {
    let mut kept = DeTable::new();
    for key in keys {
        if let Some((key, value)) = table.remove_entry(*key) {
            kept.insert(key, value);
        }
    }
    std::mem::replace(table, kept)
}

/// The first key in the text that is none of these.
fn unknown<'a, 't>(table: &'a DeTable<'t>, keys: &[&str]) -> Option<&'a Spanned<DeString<'t>>> {
    let others = table.keys().filter(|key| !keys.contains(&&**key.get_ref()));
    others.min_by_key(|key| key.span().start)
}

fn no_such<'n>(what: &str, name: &str, known: impl Iterator<Item = &'n str> + Clone) -> Complaint {
    Complaint::new(format!("there is no {what} `{name}`"), "unknown").suggest(name, known)
}

/// The parameters that a table holds, if all are in their ranges.
fn params<'t, P: Parameters>(
    source: &Source<'t>,
    table: Spanned<DeValue<'t>>,
    check: impl FnOnce(&P) -> Result<(), OutOfRange>,
) -> Result<P, SceneError> {
    let spans = table.get_ref().as_table().into_iter().flatten();
    let spans: Vec<(String, Range<usize>)> = spans
        .map(|(key, value)| (key.get_ref().to_string(), value.span()))
        .collect();
    let start = table.span().start;
    let params = P::deserialize(table.into_deserializer());
    let params = params.map_err(|error| error_of(source, &error, start..start + 1))?;
    check(&params).map_err(|error| {
        let mut spans = spans.into_iter();
        let span = spans.find(|(key, _)| key == error.key);
        let span = span.map_or(start..start + 1, |(_, span)| span);
        let title = format!("`{}` is out of range", error.key);
        let complaint = Complaint::new(title, format!("must be {}", error.range));
        source.error(span, &complaint)
    })?;
    Ok(params)
}
