//! Faces in one plane: joined to fewer large ones, or lying on each other.

pub(crate) mod covers;
pub(crate) mod merged_faces;
pub(crate) mod remainder;
