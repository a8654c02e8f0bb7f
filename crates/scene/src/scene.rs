//! A checked scene, and how it is loaded.

use crate::camera::{View, camera, views};
use crate::file::SceneFile;
use crate::image::ImageSettings;
use crate::input::{self, MeshFiles};
use crate::light::{Light, keep_used, lights};
use crate::material::{Material, materials};
use crate::settings::{FormFactorSettings, SolverSettings};
use crate::signature::foreign;
use crate::source::{Complaint, SceneError, Source};
use crate::surface::{Context, Surface, Surfaces};
use crate::vs3;
use radiosity_geometry::{self as geometry, Camera, Divisions, SurfaceId};
use std::borrow::Cow;
use std::path::Path;

/// What kind of file a scene comes from: not all say the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// TOML.
    Toml,
    /// `.vs3` of View3D: surfaces and emittances alone.
    View3D,
}

/// Everything that a scene file says.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What kind of file that is.
    pub kind: FileKind,
    /// The name of its file, without the ending.
    pub name: String,
    /// The shapes of the surfaces.
    pub geometry: Vec<geometry::Surface>,
    /// What else is known of each surface, in the same order.
    pub surfaces: Vec<Surface>,
    /// All materials.
    pub materials: Vec<Material>,
    /// The groups of emitters that are dimmed together; only those that are on surfaces.
    pub lights: Vec<Light>,
    /// The camera, if the scene has one.
    pub camera: Option<Camera>,
    /// Further cameras, in the order of the file.
    pub views: Vec<View>,
    /// The picture.
    pub image: ImageSettings,
    /// How finely surfaces are cut that do not say otherwise.
    pub divisions: Divisions,
    /// The form factor stage.
    pub form_factors: FormFactorSettings,
    /// The solver stage.
    pub solver: SolverSettings,
    /// Whether the file says that patches see nothing but fronts, so that rows should sum to 1.
    pub closed: bool,
    /// What its files say beside, and means nothing here, and what of them was left out.
    pub notes: Vec<String>,
}

impl Scene {
    /// The material of a face, by its surface and its input index.
    pub fn material(&self, surface: SurfaceId, input_face: u32) -> &Material {
        let materials = &self.surfaces[surface.index()].materials;
        &self.materials[materials[input_face as usize]]
    }

    /// The group of a face, by its surface and its input index.
    pub fn group(&self, surface: SurfaceId, input_face: u32) -> &str {
        let surface = &self.surfaces[surface.index()];
        let of_face = surface.groups_of_faces.get(input_face as usize);
        of_face.map_or(&surface.group, |group| group)
    }

    /// The camera, or else that of the first view.
    pub fn first_camera(&self) -> Option<Camera> {
        let first_view = self.views.first().map(|view| view.camera);
        self.camera.or(first_view)
    }

    /// What a material emits with its light as bright as the scene has it.
    pub fn dimmed_emission(&self, material: &Material) -> [f64; 3] {
        let light = material.light.and_then(|light| self.lights.get(light));
        let dimming = light.map_or([1.0; 3], Light::dimming);
        std::array::from_fn(|c| dimming[c] * material.emission[c])
    }

    /// The surfaces without the divisions that the scene gives them.
    pub fn undivided(&self) -> Vec<geometry::Surface> {
        self.geometry
            .iter()
            .map(geometry::Surface::without_divisions)
            .collect()
    }
}

/// Reads and checks a scene file (TOML, or `.vs3` of View3D), and the mesh files that it names,
/// which are in its folder.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    load_with(path, MeshFiles::InFolder)
}

/// [`load`] for meshes elsewhere.
pub fn load_with(path: &Path, mesh_files: MeshFiles) -> Result<Scene, SceneError> {
    if ends_in(path, "obj") {
        let help = "write a scene file with a surface: mesh = { file = \"NAME.obj\" }";
        return Err(SceneError::of_file(
            path,
            "this is a mesh, not a scene",
            help,
        ));
    }
    let bytes = input::read(path).map_err(|error| {
        let title = format!("cannot read the scene: {error}");
        SceneError::of_file(path, &title, "give the path of a scene file (.toml, .vs3)")
    })?;
    if let Some(format) = foreign(&bytes) {
        let title = format!("the scene is {}, which is not read", format.name);
        return Err(SceneError::of_file(path, &title, format.help));
    }
    // Comments and names of View3D may be in any encoding.
    let text = String::from_utf8_lossy(&bytes);
    if matches!(text, Cow::Owned(_)) && !ends_in(path, "vs3") {
        let title = "the scene is no text in UTF-8";
        return Err(SceneError::of_file(path, title, "save it as UTF-8"));
    }
    parse_with(path, &text, mesh_files)
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

/// Checks the text of a scene file; `path` says by its ending what kind it is, is what errors name,
/// and meshes are relative to it.
pub fn parse(path: &Path, text: &str) -> Result<Scene, SceneError> {
    parse_with(path, text, MeshFiles::InFolder)
}

fn parse_with(path: &Path, text: &str, mesh_files: MeshFiles) -> Result<Scene, SceneError> {
    if ends_in(path, "vs3") {
        return vs3::parse(&Source { path, text });
    }
    let source = Source { path, text };
    let file: SceneFile = toml::from_str(text).map_err(|error| {
        let complaint = Complaint::new("cannot read this scene", error.message());
        source.error(error.span().unwrap_or(0..0), &complaint)
    })?;
    let camera = file.camera.as_ref().map(|table| camera(&source, table));
    let (mut materials, names) = materials(&source, file.materials)?;
    let lights = lights(&source, &names, &file.lights)?;
    let context = Context {
        source,
        folder: path.parent().unwrap_or(Path::new("")),
        mesh_files,
        materials: &materials,
    };
    let Surfaces {
        shapes,
        surfaces,
        notes,
    } = context.surfaces(&file.surfaces)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let lights = keep_used(lights, &mut materials, &surfaces);
    Ok(Scene {
        kind: FileKind::Toml,
        name: name.into_owned(),
        geometry: shapes,
        surfaces,
        camera: camera.transpose()?,
        views: views(&source, &file.views)?,
        image: file.image.check(&source)?,
        divisions: file.discretization.check(&source)?,
        form_factors: file.form_factors.check(&source)?,
        solver: file.solver.check(&source)?,
        materials,
        lights,
        closed: false,
        notes,
    })
}
