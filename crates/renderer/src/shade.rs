//! The radiosity that a sample shows, by each shading.

use crate::Rgb;
use crate::direct::{Cutting, DirectLight, Points, Segments};
use crate::fields::Fields;
use crate::gather::Gather;
use crate::interpolate::{Interpolant, Local, Places};
use crate::render::{Shading, ShadingParams};
use crate::spots::{Gathered, Spot};
use crate::view::SampleNumbers;
use radiosity_geometry::{DVec3, Mesh};
use radiosity_simd::{Float, LANES, Simd};

/// Shows the light of patches at places of their faces.
pub(crate) struct Shader<'a> {
    mesh: &'a Mesh,
    fields: Fields<'a>,
    shadings: Vec<Shading>,
    /// All light.
    smooth: Option<Interpolant<'a>>,
    /// What comes straight from emitters.
    direct: Option<DirectLight<'a>>,
    /// What is reflected more often, from patch to patch.
    indirect: Option<Interpolant<'a>>,
    /// The same, from patches to samples.
    gather: Option<Gather<'a>>,
}

/// Memory that is used again and again.
#[derive(Default)]
pub(crate) struct Room {
    cutting: Cutting,
    pub(crate) numbers: SampleNumbers,
    /// Where light was gathered so far.
    pub(crate) spots: Vec<Spot>,
    /// The first of this pixel.
    pub(crate) first_spot: usize,
}

impl<'a> Shader<'a> {
    pub(crate) fn new(
        mesh: &'a Mesh,
        fields: &Fields<'a>,
        params: &ShadingParams,
        shadings: &[Shading],
    ) -> Shader<'a> {
        let has = |shading| shadings.contains(&shading);
        let with = (fields, params.crease_angle);
        let smooth = || Interpolant::new(mesh, with, fields.shown);
        let indirect = || {
            let patches = 0..mesh.patches.len();
            let rest = |k: usize| -> Rgb {
                let (all, direct) = (fields.shown[k], fields.direct[k]);
                std::array::from_fn(|c| all[c] - fields.emission[k][c] - direct[c])
            };
            let rest: Vec<Rgb> = patches.map(rest).collect();
            Interpolant::new(mesh, with, &rest)
        };
        let gather = || Gather::new(mesh, fields, params.crease_angle, params.directions);
        let gains = fields.gathered_gain.as_flattened();
        let shows_gathered = gains.iter().any(|gain| *gain != 0.0);
        let is_exact = has(Shading::Exact) || has(Shading::Gathered);
        Shader {
            mesh,
            fields: *fields,
            shadings: shadings.to_vec(),
            smooth: has(Shading::Smooth).then(smooth),
            direct: is_exact.then(|| DirectLight::new(mesh, fields.sources)),
            indirect: has(Shading::Exact).then(indirect),
            gather: (has(Shading::Gathered) && shows_gathered).then(gather),
        }
    }

    pub(crate) fn shadings(&self) -> &[Shading] {
        &self.shadings
    }

    /// The place of a shading among them.
    pub(crate) fn index_of(&self, shading: Shading) -> Option<usize> {
        self.shadings.iter().position(|other| *other == shading)
    }

    /// Whether places are asked for their points in space.
    pub(crate) fn needs_points(&self) -> bool {
        self.direct.is_some()
    }

    /// The radiosities at places by one of the shadings.
    #[inline(always)]
    pub(crate) fn shade<S: Simd>(
        &self,
        simd: S,
        shading: Shading,
        place: (&Places, &Local),
        room: &mut Room,
    ) -> [S::F32; 3] {
        let interpolated = match shading {
            Shading::Constant => None,
            Shading::Smooth => self.smooth.as_ref(),
            Shading::Exact => self.indirect.as_ref(),
            Shading::Gathered => return self.gathered(simd, place, room),
        };
        let Some(interpolant) = interpolated else {
            return self.constant(simd, place);
        };
        let values = interpolant.at(simd, place);
        if shading == Shading::Smooth {
            return values;
        }
        self.with_direct(simd, values, place, room)
    }

    /// The values of the patches at places.
    #[inline(always)]
    fn constant<S: Simd>(&self, simd: S, (places, local): (&Places, &Local)) -> [S::F32; 3] {
        let mut values = [simd.splat_f32(0.0); 3];
        let mut rest = places.lanes;
        while rest != 0 {
            let (patch, same) = local.first_of(rest);
            for (c, value) in values.iter_mut().enumerate() {
                let radiosity = simd.splat_f32(self.fields.shown[patch][c]);
                *value = radiosity.select(same, *value);
            }
            rest &= !same;
        }
        values
    }

    /// Emitted and direct light; the rest goes to spots.
    #[inline(always)]
    fn gathered<S: Simd>(
        &self,
        simd: S,
        (places, local): (&Places, &Local),
        room: &mut Room,
    ) -> [S::F32; 3] {
        if let (Some(gather), Some(direct)) = (&self.gather, &self.direct) {
            let with = (direct, &mut room.cutting);
            let gathered = gather.look_around(simd, places, &room.numbers, with);
            self.add_spots((places, local), &gathered, room);
        }
        self.with_direct(simd, [simd.splat_f32(0.0); 3], (places, local), room)
    }

    /// Adds samples to the spot of their pixel and face.
    fn add_spots(&self, (places, local): (&Places, &Local), gathered: &Gathered, room: &mut Room) {
        let mut of_pixel = room.spots[room.first_spot..].iter();
        let known = of_pixel.position(|spot| spot.face == places.face);
        let index = known.map_or(room.spots.len(), |known| room.first_spot + known);
        if known.is_none() {
            room.spots.push(Spot::new(places.face));
        }
        for lane in (0..LANES).filter(|lane| places.lanes >> lane & 1 != 0) {
            let at = DVec3::from_array(places.points.map(|axis| axis[lane]));
            let weight = room.numbers.weights[lane];
            let gain = self.fields.gathered_gain[local.number[lane] as usize];
            let gain = gain.map(|gain| weight * gain);
            room.spots[index].add(lane, at, gathered, gain);
        }
    }

    /// What patches emit and reflect of direct light at places, added to indirect light that leaves
    /// there.
    #[inline(always)]
    fn with_direct<S: Simd>(
        &self,
        simd: S,
        indirect: [S::F32; 3],
        (places, local): (&Places, &Local),
        room: &mut Room,
    ) -> [S::F32; 3] {
        let mut values = indirect;
        let Some(direct) = &self.direct else {
            return values;
        };
        let [x, y, z] = &places.points;
        let normal = self.mesh.faces[places.face.index()].normal;
        let points = Points {
            patches: local.number,
            at: [simd.f64(x), simd.f64(y), simd.f64(z)],
            normals: normal.to_array().map(|axis| simd.splat_f64(axis)),
            lanes: places.lanes,
            segments: Segments::Shared(room.numbers.scramble, room.numbers.first),
        };
        let irradiance = direct.irradiance(simd, &points, &mut room.cutting);
        let fields = &self.fields;
        let mut rest = places.lanes;
        while rest != 0 {
            let (patch, same) = local.first_of(rest);
            for c in 0..3 {
                let direct = irradiance[c] * simd.splat_f32(fields.direct_gain[patch][c]);
                let emission = simd.splat_f32(fields.emission[patch][c]);
                let sum = values[c] + direct + emission;
                values[c] = sum.select(same, values[c]);
            }
            rest &= !same;
        }
        values
    }
}
