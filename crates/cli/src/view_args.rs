//! From where pictures are taken, on the command line.

use super::choices::{BACKS, choice};
use crate::error::Error;
use clap::Args;
use radiosity::geometry::{Backs, Camera, Mesh};
use radiosity::scene::{ALL_VIEWS, FIRST_VIEW, Scene, suggestion};

/// From where pictures are taken.
#[derive(Debug, Args)]
#[command(next_help_heading = "Views")]
pub struct ViewArgs {
    /// The scene's views by their names, or all [default: camera, the first one]
    #[arg(long, value_name = "NAME,..|all", value_delimiter = ',')]
    pub views: Vec<String>,
    /// Turn once around what each view shows, in N numbered pictures
    ///
    /// The camera turns around what is in the middle of the picture, as far away as the middle of
    /// the scene.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=9999))]
    pub turntable: Option<u32>,
    /// Go along a smooth path through the views (all, if not told otherwise), in N numbered
    /// pictures
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(2..=9999),
        conflicts_with = "turntable",
    )]
    pub path: Option<u32>,
    /// What is seen of the backs of surfaces [default: the scene's, or black]
    #[arg(long, value_parser = choice::<Backs>(&BACKS))]
    pub backs: Option<Backs>,
    /// Write a sheet of all pictures of the run, too: NAME-sheet.png
    #[arg(long)]
    pub sheet: bool,
}

/// A camera, and what its pictures are called; those of the scene's first one are not.
#[derive(Clone)]
pub(super) struct ViewFrame {
    pub(super) name: Option<String>,
    pub(super) camera: Camera,
}

impl ViewArgs {
    /// All cameras, in order.
    pub(super) fn shots(&self, scene: &Scene, mesh: &Mesh) -> Result<Vec<ViewFrame>, Error> {
        let wanted = self.wanted(scene)?;
        if let Some(count) = self.turntable {
            let bounds = mesh.bounds();
            let center = 0.5 * (bounds.min + bounds.max);
            let turn = |shot: &ViewFrame| {
                let view = shot.name.as_ref().map(|name| format!("{name}-"));
                let name = format!("{}turntable", view.unwrap_or_default());
                frames(name, shot.camera.turntable(center, count))
            };
            return Ok(wanted.iter().flat_map(turn).collect());
        }
        if let Some(count) = self.path {
            let stations: Vec<Camera> = wanted.iter().map(|shot| shot.camera).collect();
            if stations.len() < 2 {
                return Err(Error::with_help(
                    "a path goes through two views at least",
                    "add [[views]] to the scene, each with a `name` and a `camera`",
                ));
            }
            let path = Camera::path(&stations, count).map_err(|error| {
                Error::with_help(
                    format!("the camera cannot look on its way from view to view: {error}"),
                    "add a view where it turns",
                )
            })?;
            return Ok(frames("path".to_owned(), path).collect());
        }
        Ok(wanted)
    }

    /// The scene's cameras that are asked for; not none.
    fn wanted(&self, scene: &Scene) -> Result<Vec<ViewFrame>, Error> {
        let first = scene.camera.iter().map(|camera| ViewFrame {
            name: None,
            camera: *camera,
        });
        let others = scene.views.iter().map(|view| ViewFrame {
            name: Some(view.name.clone()),
            camera: view.camera,
        });
        let mut all: Vec<ViewFrame> = first.chain(others).collect();
        if all.is_empty() {
            return Err(radiosity::Error::no_camera(scene).into());
        }
        if self.views.is_empty() {
            if self.path.is_none() {
                all.truncate(1);
            }
            return Ok(all);
        }
        let called = |shot: &ViewFrame| shot.name.clone().unwrap_or(FIRST_VIEW.to_owned());
        let known: Vec<String> = all.iter().map(called).collect();
        let mut wanted = Vec::new();
        for name in self.views.iter().filter(|name| *name != ALL_VIEWS) {
            let Some(index) = known.iter().position(|known| known == name) else {
                let help = suggestion(name, known.iter().map(String::as_str));
                return Err(Error::with_help(
                    format!("there is no view `{name}`"),
                    help.unwrap_or_default(),
                ));
            };
            if !wanted.contains(&index) {
                wanted.push(index);
            }
        }
        if self.views.iter().any(|name| name == ALL_VIEWS) {
            return Ok(all);
        }
        Ok(wanted.into_iter().map(|index| all[index].clone()).collect())
    }
}

/// Numbered pictures.
fn frames(name: String, cameras: Vec<Camera>) -> impl Iterator<Item = ViewFrame> {
    let frame = move |(camera, k): (Camera, u32)| ViewFrame {
        name: Some(format!("{name}-{k:04}")),
        camera,
    };
    cameras.into_iter().zip(1..).map(frame)
}
