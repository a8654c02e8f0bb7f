//! What patches shine with.
//!
//! A radiosity is the mean over what of a patch exchanges light, its element
//! ([`FormFactors::exchange`](radiosity_form_factors::FormFactors::exchange)). In the accurate mode
//! a part of a patch that lies inside of something, or is covered, is no part of the element.

use crate::energy::Energy;

/// What patches shine with, each list indexed by patch.
#[derive(Clone, Debug)]
pub struct PatchLight {
    /// What patches emit themselves, W/m^2 per channel.
    pub emission: Vec<[f32; 3]>,
    /// Radiosities of elements, W/m^2 per channel.
    pub radiosity: Vec<[f32; 3]>,
    /// The part of them that patches reflect of what comes straight from emitters.
    pub direct: Vec<[f32; 3]>,
    /// The shares of patches that are elements.
    pub elements: Vec<f32>,
    /// The share of each patch that can be seen; 0 stands for too little to tell it apart.
    pub visible: Vec<f32>,
    /// Where the power of the lights goes.
    pub energy: Energy,
}

impl PatchLight {
    /// The mean radiosities over whole patches, without what other faces cover: what is no element
    /// does nothing but emit.
    pub fn mean_radiosity(&self) -> Vec<[f32; 3]> {
        let patches = self.emission.iter().zip(&self.radiosity);
        let mean = |((emission, radiosity), share): ((&[f32; 3], &[f32; 3]), &f32)| {
            std::array::from_fn(|c| emission[c] + share * (radiosity[c] - emission[c]))
        };
        patches.zip(&self.elements).map(mean).collect()
    }
}
