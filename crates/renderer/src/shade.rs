//! The radiosity that a sample shows, by each shading.

use crate::Rgb;
use crate::direct::{Cutting, DirectLight, Points};
use crate::exposed::exposed;
use crate::fields::Fields;
use crate::interpolate::{Interpolant, Local, Places};
use crate::render::Shading;
use radiosity_geometry::Mesh;
use radiosity_simd::{Float, Simd};

/// Shows the light of patches at places of their faces.
pub(crate) struct Shader<'a> {
    fields: Fields<'a>,
    shadings: Vec<Shading>,
    smooth: Option<Interpolant<'a>>,
    exact: Option<Exact<'a>>,
}

/// What comes straight from emitters, and what is reflected more often.
struct Exact<'a> {
    direct: DirectLight<'a>,
    indirect: Interpolant<'a>,
}

/// Memory that is used again and again.
#[derive(Default)]
pub(crate) struct Room {
    cutting: Cutting,
}

impl<'a> Shader<'a> {
    pub(crate) fn new(
        mesh: &'a Mesh,
        fields: &Fields<'a>,
        crease_angle: f64,
        shadings: &[Shading],
    ) -> Shader<'a> {
        let interpolant = |value: &dyn Fn(usize) -> Rgb| {
            let values: Vec<Rgb> = (0..mesh.patches.len()).map(value).collect();
            Interpolant::new(mesh, fields, &values, crease_angle)
        };
        let (radiosity, emission) = (fields.radiosity, fields.emission);
        let smooth = || interpolant(&|k| exposed(fields, k, radiosity[k], emission[k]));
        let indirect = |k: usize| -> Rgb {
            let rest = |c: usize| radiosity[k][c] - emission[k][c] - fields.direct[k][c];
            exposed(fields, k, [rest(0), rest(1), rest(2)], [0.0; 3])
        };
        let exact = || Exact {
            direct: DirectLight::new(mesh, fields.sources),
            indirect: interpolant(&indirect),
        };
        Shader {
            fields: *fields,
            shadings: shadings.to_vec(),
            smooth: shadings.contains(&Shading::Smooth).then(smooth),
            exact: shadings.contains(&Shading::Exact).then(exact),
        }
    }

    pub(crate) fn shadings(&self) -> &[Shading] {
        &self.shadings
    }

    /// Whether places are asked for their points in space.
    pub(crate) fn needs_points(&self) -> bool {
        self.exact.is_some()
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
        match (shading, &self.smooth, &self.exact) {
            (Shading::Smooth, Some(smooth), _) => smooth.at(simd, place),
            (Shading::Exact, _, Some(exact)) => self.exact(simd, exact, place, room),
            _ => self.constant(simd, place),
        }
    }

    /// The values of the patches at places.
    #[inline(always)]
    fn constant<S: Simd>(&self, simd: S, (places, local): (&Places, &Local)) -> [S::F32; 3] {
        let mut values = [simd.splat_f32(0.0); 3];
        let mut rest = places.lanes;
        while rest != 0 {
            let (patch, same) = local.first_of(rest);
            for (c, value) in values.iter_mut().enumerate() {
                let radiosity = simd.splat_f32(self.fields.radiosity[patch][c]);
                *value = radiosity.select(same, *value);
            }
            rest &= !same;
        }
        values
    }

    #[inline(always)]
    fn exact<S: Simd>(
        &self,
        simd: S,
        exact: &Exact<'_>,
        (places, local): (&Places, &Local),
        room: &mut Room,
    ) -> [S::F32; 3] {
        let mut values = exact.indirect.at(simd, (places, local));
        let [x, y, z] = &places.points;
        let mut rest = places.lanes;
        while rest != 0 {
            let (patch, same) = local.first_of(rest);
            let points = Points {
                patch,
                at: [simd.f64(x), simd.f64(y), simd.f64(z)],
                lanes: same,
            };
            let irradiance = exact.direct.irradiance(simd, &points, &mut room.cutting);
            let (emission, reflectance) =
                (self.fields.emission[patch], self.fields.reflectance[patch]);
            for c in 0..3 {
                let direct = irradiance[c] * simd.splat_f32(reflectance[c]);
                let sum = values[c] + direct + simd.splat_f32(emission[c]);
                values[c] = sum.select(same, values[c]);
            }
            rest &= !same;
        }
        values
    }
}
