//! The parameters of the stage: how finely each surface is cut.

use crate::shape::Shape;
use crate::subdivide::Surface;
use radiosity_params::{OutOfRange, Parameters, is_positive};
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// How finely a surface is cut. In files, `divisions = 12`, `divisions = [12, 8]` or
/// `max_patch_edge = 0.1`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Cells", into = "Cells")]
pub enum Divisions {
    /// `a x b` cells on parallelograms and quads; `a^2` on triangles, where `a` equals `b`. At
    /// least 1.
    Count {
        /// Cells along edge a.
        a: u32,
        /// Cells along edge b.
        b: u32,
    },
    /// As few cells as keep every patch edge at most this long, in scene units. Faces of meshes
    /// take the next power of two, so that neighbours of different size fit together. Triangles
    /// that are narrow are cut along each edge as its length asks for, the others alike along all
    /// edges.
    MaxEdge(f64),
    /// No cells at all: the surface stands in the way, and neither emits nor receives. In files,
    /// `divisions = "none"`.
    Uncut,
}

/// A shape of a scene, and what tells how it is cut.
#[derive(Clone, Copy, Debug)]
pub struct NamedShape<'a> {
    /// The name of its surface.
    pub name: &'a str,
    /// Its geometry.
    pub shape: &'a Shape,
    /// Whether it only stands in the way: it is not cut, whatever the rules say.
    pub is_obstruction: bool,
}

/// How finely all surfaces of a scene are cut.
///
/// ```
/// use radiosity_geometry::{Discretization, Divisions};
///
/// let mut params = Discretization::default();
/// assert_eq!(params.default, Divisions::uniform(12));
/// params.surfaces.insert("floor".to_owned(), Divisions::MaxEdge(0.1));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Discretization {
    /// The rule for surfaces that have none of their own. A count leaves the faces of meshes
    /// whole. Default: 12.
    pub default: Divisions,
    /// Rules of single surfaces, by their names.
    pub surfaces: BTreeMap<String, Divisions>,
}

impl Divisions {
    /// The same count along both edges.
    pub const fn uniform(n: u32) -> Divisions {
        Divisions::Count { a: n, b: n }
    }

    /// Whether a shape can be cut like this: triangles take one count.
    pub fn suit(&self, shape: &Shape) -> bool {
        match *self {
            Divisions::Count { a, b } if a != b => shape
                .polygons()
                .is_ok_and(|polygons| !polygons.iter().any(|(_, polygon)| polygon.is_triangle())),
            _ => true,
        }
    }
}

impl Default for Divisions {
    fn default() -> Divisions {
        Divisions::uniform(12)
    }
}

impl Parameters for Divisions {
    fn check(&self) -> Result<(), OutOfRange> {
        match *self {
            Divisions::Count { a, b } => {
                OutOfRange::unless(a >= 1 && b >= 1, "divisions", "at least 1")
            }
            Divisions::MaxEdge(length) => {
                OutOfRange::unless(is_positive(length), "max_patch_edge", "a positive length")
            }
            Divisions::Uncut => Ok(()),
        }
    }
}

impl Parameters for Discretization {
    fn check(&self) -> Result<(), OutOfRange> {
        self.default.check()?;
        self.surfaces.values().try_for_each(Divisions::check)
    }
}

impl Discretization {
    /// Every surface cut in the same way.
    pub fn uniform(n: u32) -> Discretization {
        Discretization::from(Divisions::uniform(n))
    }

    /// Every face one patch, but for surfaces whose rule is that they have none.
    pub fn by_faces(&self) -> Discretization {
        let uncut = self.surfaces.iter();
        let uncut = uncut.filter(|(_, divisions)| **divisions == Divisions::Uncut);
        Discretization {
            default: Divisions::uniform(1),
            surfaces: uncut.map(|(name, own)| (name.clone(), *own)).collect(),
        }
    }

    /// The surfaces for [`subdivide`](crate::subdivide()), each with its rule.
    pub fn of_shapes<'a>(&self, shapes: impl IntoIterator<Item = NamedShape<'a>>) -> Vec<Surface> {
        let surface = |named: NamedShape<'_>| Surface {
            shape: named.shape.clone(),
            divisions: match named.is_obstruction {
                true => Some(Divisions::Uncut),
                false => self.surfaces.get(named.name).copied(),
            },
        };
        shapes.into_iter().map(surface).collect()
    }
}

impl From<Divisions> for Discretization {
    fn from(default: Divisions) -> Discretization {
        Discretization {
            default,
            surfaces: BTreeMap::new(),
        }
    }
}

/// [`Divisions`] as files have them.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Cells {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    divisions: Option<Counts>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    max_patch_edge: Option<f64>,
}

/// `12`, `[12, 8]` or `"none"`.
#[derive(Serialize)]
#[serde(untagged)]
enum Counts {
    Both(u32, u32),
    None(&'static str),
}

const NONE: &str = "none";

impl TryFrom<Cells> for Divisions {
    type Error = &'static str;

    fn try_from(cells: Cells) -> Result<Divisions, &'static str> {
        match (cells.divisions, cells.max_patch_edge) {
            (Some(Counts::Both(a, b)), None) => Ok(Divisions::Count { a, b }),
            (Some(Counts::None(_)), None) => Ok(Divisions::Uncut),
            (None, Some(length)) => Ok(Divisions::MaxEdge(length)),
            (None, None) => Ok(Divisions::default()),
            (Some(_), Some(_)) => {
                Err("`divisions` and `max_patch_edge` exclude each other: remove one of them")
            }
        }
    }
}

impl From<Divisions> for Cells {
    fn from(divisions: Divisions) -> Cells {
        let (divisions, max_patch_edge) = match divisions {
            Divisions::Count { a, b } => (Some(Counts::Both(a, b)), None),
            Divisions::MaxEdge(length) => (None, Some(length)),
            Divisions::Uncut => (Some(Counts::None(NONE)), None),
        };
        Cells {
            divisions,
            max_patch_edge,
        }
    }
}

impl<'de> Deserialize<'de> for Counts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Counts, D::Error> {
        struct CountsVisitor;
        impl<'de> Visitor<'de> for CountsVisitor {
            type Value = Counts;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a whole number, two whole numbers [along a, along b], or \"none\"")
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Counts, E> {
                let unexpected = serde::de::Unexpected::Signed(value);
                let count =
                    u32::try_from(value).map_err(|_| Error::invalid_value(unexpected, &self))?;
                Ok(Counts::Both(count, count))
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<Counts, E> {
                let value = i64::try_from(value).unwrap_or(i64::MAX);
                self.visit_i64(value)
            }

            fn visit_str<E: Error>(self, word: &str) -> Result<Counts, E> {
                if word == NONE {
                    Ok(Counts::None(NONE))
                } else {
                    Err(E::invalid_value(serde::de::Unexpected::Str(word), &self))
                }
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<Counts, A::Error> {
                let mut counts = Vec::new();
                while let Some(count) = sequence.next_element()? {
                    counts.push(count);
                }
                match counts[..] {
                    [a, b] => Ok(Counts::Both(a, b)),
                    _ => Err(Error::invalid_length(counts.len(), &self)),
                }
            }
        }
        deserializer.deserialize_any(CountsVisitor)
    }
}
