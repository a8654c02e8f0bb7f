//! What pictures show.

mod closed_forms;
mod direct;
mod gather;
mod light;
mod meshes;
mod overlay;
mod pictures;
mod seams;
mod smooth;
mod smooth_meshes;
mod square;
mod threads;
