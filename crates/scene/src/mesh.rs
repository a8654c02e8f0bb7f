//! `mesh = { … }` of `[[surfaces]]`.

use crate::obj;
use crate::source::{Complaint, SceneError, Source};
use crate::surface::{Context, Geometry};
use crate::values::{Vector, require, vector};
use radiosity_geometry::{DVec3, PolygonMesh, Shape, ShapeError};
use serde::Deserialize;
use std::path::Path;
use toml::Spanned;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MeshTable {
    file: Spanned<String>,
    scale: Option<Spanned<f64>>,
    translate: Option<Vector>,
}

impl Context<'_> {
    pub(crate) fn mesh(&self, table: &MeshTable) -> Result<Geometry, SceneError> {
        let path = self.folder.join(table.file.get_ref());
        let bytes = std::fs::read(&path).map_err(|error| {
            let file = table.file.get_ref();
            let complaint = Complaint::new(format!("cannot read the mesh `{file}`: {error}"), "")
                .suggest(file, self.obj_files_near(file).iter().map(String::as_str));
            self.source.error(table.file.span(), &complaint)
        })?;
        // Comments and names may be in any encoding.
        let text = String::from_utf8_lossy(&bytes);
        let source = Source {
            path: &path,
            text: &text,
        };
        let obj::ObjMesh { mut mesh, labels } = obj::parse(&source)?;
        self.transform(table, &mut mesh)?;
        let shape = Shape::Mesh(mesh);
        if let Err(ShapeError::FaceWithoutArea { face }) = shape.polygons() {
            let title = "this face has no area";
            let complaint = Complaint::new(title, "its corners coincide or lie on a line")
                .help("remove it from the mesh");
            return Err(source.error_in_line(labels[face].line(&text), &complaint));
        }
        Ok(Geometry {
            shape,
            span: table.file.span(),
            labels,
        })
    }

    fn transform(&self, table: &MeshTable, mesh: &mut PolygonMesh) -> Result<(), SceneError> {
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
        for position in &mut mesh.positions {
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
