//! `mesh = { … }` of `[[surfaces]]`.

use crate::error::Help;
use crate::obj;
use crate::signature::foreign;
use crate::source::{Complaint, SceneError, Source};
use crate::surface::{Geometry, SurfaceReader};
use crate::values::{Vector, require, vector};
use radiosity_geometry::DVec3;
use serde::Deserialize;
use std::borrow::Cow;
use std::path::Path;
use toml::Spanned;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeshTable {
    file: Spanned<String>,
    scale: Option<Spanned<f64>>,
    translate: Option<Vector>,
}

impl SurfaceReader<'_> {
    pub(crate) fn mesh(&self, table: &MeshTable) -> Result<Geometry, SceneError> {
        let path = self.folder.join(table.file.get_ref());
        let complain = |title: String, help: &str| {
            let complaint = Complaint::new(title, "this file").help(help);
            Err(self.source.error(table.file.span(), &complaint))
        };
        if !self.mesh_files.include(&path, self.folder) {
            let title = "the mesh is outside of the scene's folder";
            let complaint = Complaint::new(title, "this file").typed_help(Help::MeshFolder);
            return Err(self.source.error(table.file.span(), &complaint));
        }
        let file = table.file.get_ref();
        let bytes = self.mesh_files.read(self.folder, file).map_err(|error| {
            let complaint = Complaint::new(format!("cannot read the mesh `{file}`: {error}"), "")
                .suggest(file, self.obj_files_near(file).iter().map(String::as_str));
            self.source.error(table.file.span(), &complaint)
        })?;
        if let Some(format) = foreign(&bytes) {
            let title = format!("the mesh is {}, which is not read", format.name);
            return complain(title, format.help);
        }
        let text = text_of(&bytes);
        let source = Source {
            path: &path,
            text: &text,
        };
        let mut file = obj::parse(&source)?;
        self.transform(table, &mut file.positions)?;
        let unknown = file.note();
        let mesh = file.cut(&source)?;
        let notes: Vec<String> = mesh.note().into_iter().chain(unknown).collect();
        if mesh.labels.is_empty() {
            let notes: String = notes.iter().map(|note| format!("; {note}")).collect();
            let help = "faces are lines of numbers of vertices, like: f 1 2 3";
            return complain(format!("the mesh has no faces{notes}"), help);
        }
        let file = table.file.get_ref();
        Ok(Geometry {
            shape: mesh.shape,
            span: table.file.span(),
            labels: mesh.labels,
            notes: notes.iter().map(|note| format!("{file}: {note}")).collect(),
        })
    }

    fn transform(&self, table: &MeshTable, positions: &mut [DVec3]) -> Result<(), SceneError> {
        let mut scale = 1.0;
        if let Some(entry) = &table.scale {
            let positive = |&x: &f64| x > 0.0 && x.is_finite();
            require(
                &self.source,
                entry,
                positive,
                "`scale`",
                "a positive number",
            )?;
            scale = *entry.get_ref();
        }
        let offset = match &table.translate {
            Some(offset) => vector(&self.source, offset, "`translate`")?,
            None => DVec3::ZERO,
        };
        for position in positions {
            *position = scale * *position + offset;
        }
        Ok(())
    }

    /// The mesh files in the folder that `file` names, for suggestions.
    fn obj_files_near(&self, file: &str) -> Vec<String> {
        let named = Path::new(file).parent().unwrap_or(Path::new(""));
        let Ok(entries) = std::fs::read_dir(self.folder.join(named)) else {
            return Vec::new();
        };
        let mut names: Vec<String> = entries
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
            .filter(|name| name.ends_with(".obj"))
            .map(|name| named.join(name).display().to_string())
            .collect();
        names.sort();
        names
    }
}

/// The text of a file: comments and names may be in any encoding, and old programs end lines by a
/// carriage return alone.
fn text_of(bytes: &[u8]) -> Cow<'_, str> {
    let text = String::from_utf8_lossy(bytes);
    let has_bare_return = text.split('\r').skip(1).any(|rest| !rest.starts_with('\n'));
    match has_bare_return {
        true => Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")),
        false => text,
    }
}
