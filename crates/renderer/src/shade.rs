//! The radiosity that a sample shows, by each shading.

use crate::Rgb;
use crate::direct::{Cutting, DirectLight, EmitterSamples, Receivers};
use crate::fields::Fields;
use crate::gather::Gather;
use crate::interpolate::{Interpolant, PatchCoords, SurfacePoints};
use crate::irradiance_filter::{Fragment, Gathered};
use crate::params::ImageParams;
use crate::pixel_sampler::SampleNumbers;
use crate::render::Shading;
use crate::shading_normals::{ShadingNormals, Smooth};
use radiosity_geometry::{DVec2, DVec3, Mesh};
use radiosity_simd::{Float, LANES, Simd};

/// Shows the light of patches at points of their faces.
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
pub(crate) struct Workspace {
    cutting: Cutting,
    pub(crate) numbers: SampleNumbers,
    /// Where light was gathered so far.
    pub(crate) fragments: Vec<Fragment>,
    /// The first of this pixel.
    pub(crate) first_fragment: usize,
}

impl<'a> Shader<'a> {
    pub(crate) fn new(
        mesh: &'a Mesh,
        fields: &Fields<'a>,
        params: &ImageParams,
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
            direct: is_exact.then(|| {
                let normals = ShadingNormals::new(mesh, params.crease_angle);
                DirectLight::new(mesh, fields.sources, normals)
            }),
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

    /// Whether points are asked for their points in space.
    pub(crate) fn needs_points(&self) -> bool {
        self.direct.is_some()
    }

    /// The radiosities at points by one of the shadings.
    #[inline(always)]
    pub(crate) fn shade<S: Simd>(
        &self,
        simd: S,
        shading: Shading,
        points: (&SurfacePoints, &PatchCoords),
        workspace: &mut Workspace,
    ) -> [S::F32; 3] {
        let interpolated = match shading {
            Shading::Constant => None,
            Shading::Smooth => self.smooth.as_ref(),
            Shading::Exact => self.indirect.as_ref(),
            Shading::Gathered => return self.gathered(simd, points, workspace),
        };
        let Some(interpolant) = interpolated else {
            return self.constant(simd, points);
        };
        let values = interpolant.at(simd, points);
        if shading == Shading::Smooth {
            return values;
        }
        self.with_direct(simd, values, points, workspace)
    }

    /// The values of the patches at points.
    #[inline(always)]
    fn constant<S: Simd>(
        &self,
        simd: S,
        (points, coords): (&SurfacePoints, &PatchCoords),
    ) -> [S::F32; 3] {
        let mut values = [simd.splat_f32(0.0); 3];
        let mut rest = points.lanes;
        while rest != 0 {
            let (patch, same) = coords.first_of(rest);
            for (c, value) in values.iter_mut().enumerate() {
                let radiosity = simd.splat_f32(self.fields.shown[patch][c]);
                *value = radiosity.select(same, *value);
            }
            rest &= !same;
        }
        values
    }

    /// Emitted and direct light; the rest goes to fragments.
    #[inline(always)]
    fn gathered<S: Simd>(
        &self,
        simd: S,
        (points, coords): (&SurfacePoints, &PatchCoords),
        workspace: &mut Workspace,
    ) -> [S::F32; 3] {
        if let (Some(gather), Some(direct)) = (&self.gather, &self.direct) {
            let with = (direct, &mut workspace.cutting);
            let gathered = gather.look_around(simd, points, &workspace.numbers, with);
            self.add_to_fragment((points, coords), &gathered, workspace);
        }
        self.with_direct(simd, [simd.splat_f32(0.0); 3], (points, coords), workspace)
    }

    /// Adds samples to the fragment of their pixel and face.
    fn add_to_fragment(
        &self,
        (points, coords): (&SurfacePoints, &PatchCoords),
        gathered: &Gathered,
        workspace: &mut Workspace,
    ) {
        let mut of_pixel = workspace.fragments[workspace.first_fragment..].iter();
        let known = of_pixel.position(|fragment| fragment.face == points.face);
        let index = known.map_or(workspace.fragments.len(), |known| {
            workspace.first_fragment + known
        });
        if known.is_none() {
            workspace.fragments.push(Fragment::new(points.face));
        }
        for lane in (0..LANES).filter(|lane| points.lanes >> lane & 1 != 0) {
            let at = DVec3::from_array(points.in_space.map(|axis| axis[lane]));
            let weight = workspace.numbers.weights[lane];
            let gain = self.fields.gathered_gain[coords.number[lane] as usize];
            let gain = gain.map(|gain| weight * gain);
            workspace.fragments[index].add(lane, at, gathered, gain);
        }
    }

    /// What patches emit and reflect of direct light at points, added to indirect light that leaves
    /// there.
    #[inline(always)]
    fn with_direct<S: Simd>(
        &self,
        simd: S,
        indirect: [S::F32; 3],
        (points, coords): (&SurfacePoints, &PatchCoords),
        workspace: &mut Workspace,
    ) -> [S::F32; 3] {
        let mut values = indirect;
        let Some(direct) = &self.direct else {
            return values;
        };
        let (at, normals) = match direct.smooth(points.face) {
            Some(smooth) => smooth_points(smooth, points),
            None => {
                let normal = self.mesh.faces[points.face.index()].normal;
                (points.in_space, normal.to_array().map(|axis| [axis; LANES]))
            }
        };
        let ([x, y, z], [u, v, w]) = (&at, &normals);
        let receivers = Receivers {
            patches: coords.number,
            at: [simd.f64(x), simd.f64(y), simd.f64(z)],
            normals: [simd.f64(u), simd.f64(v), simd.f64(w)],
            lanes: points.lanes,
            samples: EmitterSamples::Shared(workspace.numbers.scramble, workspace.numbers.first),
        };
        let irradiance = direct.irradiance(simd, &receivers, &mut workspace.cutting);
        let fields = &self.fields;
        let mut rest = points.lanes;
        while rest != 0 {
            let (patch, same) = coords.first_of(rest);
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

/// Eight points of a smooth face and their normals, by axes.
fn smooth_points(
    smooth: Smooth<'_>,
    points: &SurfacePoints,
) -> ([[f64; LANES]; 3], [[f64; LANES]; 3]) {
    let (mut at, mut normals) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3]);
    for lane in 0..LANES {
        let on_face = DVec2::from_array(points.on_face.map(|axis| axis[lane]));
        let point = DVec3::from_array(points.in_space.map(|axis| axis[lane]));
        let (point, normal) = smooth.at(on_face, point);
        for axis in 0..3 {
            (at[axis][lane], normals[axis][lane]) = (point[axis], normal[axis]);
        }
    }
    (at, normals)
}
