//! Patches of which nothing can be seen: they must not shine through to their neighbours by
//! interpolation.

use crate::Rgb;
use crate::fields::Fields;
use radiosity_geometry::{Face, Grid};

/// Whether anything of a patch can be seen.
pub(crate) fn is_visible(fields: &Fields<'_>, patch: usize) -> bool {
    fields.visible[patch] > 0.0
}

/// The values of a face's patches, where hidden ones continue their neighbours: for neighbours to
/// be interpolated with. Nothing if none is hidden, or all are.
pub(crate) fn continued(fields: &Fields<'_>, face: &Face, values: &[Rgb]) -> Option<Vec<Rgb>> {
    let Grid::Quad { a, b } = face.grid else {
        return None;
    };
    let known = face.patches().map(|patch| is_visible(fields, patch));
    let known: Vec<bool> = known.collect();
    if !known.contains(&false) || !known.contains(&true) {
        return None;
    }
    let mut continued = values[face.patches()].to_vec();
    fill(&mut continued, known, [a as usize, b as usize]);
    Some(continued)
}

/// Gives cells of a grid that are not known the mean of their neighbours that are, ring by ring.
/// One at least must be known.
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
