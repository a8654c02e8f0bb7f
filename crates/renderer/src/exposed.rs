//! What patches shine with where they can be seen.
//!
//! A patch of which a part lies inside of something, or is covered, has the mean radiosity of all of
//! it; but pictures show the other part alone, which is brighter. And what is hidden altogether
//! must not shine through to its neighbours by interpolation.

use crate::Rgb;
use crate::fields::Fields;
use radiosity_geometry::{Face, Grid};

/// Patches of which less can be seen count as hidden: too little is known of that part.
const LEAST_VISIBLE: f32 = 0.2;

/// Whether enough of a patch can be seen.
pub(crate) fn is_exposed(fields: &Fields<'_>, patch: usize) -> bool {
    fields.visible[patch] >= LEAST_VISIBLE
}

/// The value of a patch where it can be seen, given the mean over all of it; `dark` is what the hidden
/// part has.
pub(crate) fn exposed(fields: &Fields<'_>, patch: usize, mean: Rgb, dark: Rgb) -> Rgb {
    if !is_exposed(fields, patch) {
        return mean;
    }
    std::array::from_fn(|c| dark[c] + (mean[c] - dark[c]) / fields.visible[patch])
}

/// The values of a face's patches, where hidden ones continue their neighbours: for neighbours to be
/// interpolated with. Nothing if none is hidden, or all are.
pub(crate) fn continued(fields: &Fields<'_>, face: &Face, values: &[Rgb]) -> Option<Vec<Rgb>> {
    let Grid::Quad { a, b } = face.grid else {
        return None;
    };
    let known = face.patches().map(|patch| is_exposed(fields, patch));
    let known: Vec<bool> = known.collect();
    if !known.contains(&false) || !known.contains(&true) {
        return None;
    }
    let mut continued = values[face.patches()].to_vec();
    fill(&mut continued, known, [a as usize, b as usize]);
    Some(continued)
}

/// Gives cells of a grid that are not known the mean of their neighbours that are, ring by ring. One at
/// least must be known.
fn fill(values: &mut [Rgb], mut known: Vec<bool>, [a, b]: [usize; 2]) {
    while known.contains(&false) {
        let before = known.clone();
        for cell in (0..a * b).filter(|&cell| !before[cell]) {
            let (i, j) = (cell / b, cell % b);
            let around = [
                (i > 0).then(|| cell - b),
                (i + 1 < a).then(|| cell + b),
                (j > 0).then(|| cell - 1),
                (j + 1 < b).then(|| cell + 1),
            ];
            let around = around.into_iter().flatten();
            let around: Vec<Rgb> = around.filter(|&k| before[k]).map(|k| values[k]).collect();
            if !around.is_empty() {
                let mean =
                    |c: usize| around.iter().map(|v| v[c]).sum::<f32>() / around.len() as f32;
                values[cell] = [mean(0), mean(1), mean(2)];
                known[cell] = true;
            }
        }
    }
}
