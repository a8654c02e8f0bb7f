//! The linear system.

use crate::Rgb;
use radiosity_matrix::SymmetricMatrix;
use std::borrow::Cow;

/// `(I - rho F) B = E` for each light, by its parts. All slices but the lights are indexed by
/// patch.
#[derive(Clone, Debug)]
pub struct System<'a> {
    /// `S_ij = A_i F_ij`, in units of the total area.
    pub exchange: &'a SymmetricMatrix,
    /// The area of each patch that nothing lies on, in square scene units; 0 for a patch that is
    /// covered, which exchanges nothing.
    pub areas: &'a [f64],
    /// The share of that area that exchanges light, in (0, 1]; the rest lies inside of something.
    /// Radiosities are those of this part.
    pub visible: Cow<'a, [f64]>,
    /// Diffuse reflectance of each patch, in [0, 1].
    pub reflectance: &'a [Rgb],
    /// Of each light, the radiant exitance that each patch emits itself, W/m^2, >= 0.
    pub lights: &'a [Vec<Rgb>],
    /// The shares of what each patch sees that are backs, and nothing at all.
    pub backs: Cow<'a, [f64]>,
    /// See `backs`.
    pub background: Cow<'a, [f64]>,
}

impl<'a> System<'a> {
    /// A system in which all of each patch exchanges light. What backs and the background receive
    /// is not known, so the energy balance lacks it.
    pub fn new(
        exchange: &'a SymmetricMatrix,
        areas: &'a [f64],
        reflectance: &'a [Rgb],
        lights: &'a [Vec<Rgb>],
    ) -> System<'a> {
        let nothing = vec![0.0; areas.len()];
        System {
            exchange,
            areas,
            visible: vec![1.0; areas.len()].into(),
            reflectance,
            lights,
            backs: nothing.clone().into(),
            background: nothing.into(),
        }
    }

    /// The sum of all these areas.
    pub fn total_area(&self) -> f64 {
        self.areas.iter().sum()
    }

    /// The area of a patch that exchanges light.
    pub(crate) fn visible_area(&self, i: usize) -> f64 {
        self.visible[i] * self.areas[i]
    }

    pub(crate) fn size(&self) -> usize {
        self.exchange.size()
    }
}
