//! Radiosities and irradiances as tables for other programs.

use crate::export::input_order;
use crate::factor_export::By;
use crate::stages::PatchLight;
use radiosity_compare::table_name;
use radiosity_geometry::{DVec3, Mesh};
use radiosity_scene::Scene;
use std::collections::HashMap;

/// The light of a scene, ready for export: a row per patch, in input order, or per surface or group
/// with means by area.
pub struct LightExport<'a> {
    rows: Vec<LightRow<'a>>,
    by: By,
}

struct LightRow<'a> {
    surface: &'a str,
    group: &'a str,
    /// Of patches.
    cell: [u32; 2],
    area: f64,
    centroid: DVec3,
    /// Means over the area, hidden parts included.
    radiosity: [f64; 3],
    irradiance: [f64; 3],
    visible: f64,
}

/// About the bytes of a row: numbers of single precision have up to eleven characters.
const BYTES_OF_ROW: u64 = 170;

/// About the bytes of a table of so many patches.
pub fn light_export_bytes(patches: u64) -> u64 {
    BYTES_OF_ROW * patches
}

impl<'a> LightExport<'a> {
    /// `irradiance` is the mean of what arrives at each patch, W/m^2
    /// ([`mean_irradiance`](crate::stages::mean_irradiance)).
    pub fn new(
        scene: &'a Scene,
        mesh: &Mesh,
        light: &PatchLight,
        irradiance: &[[f32; 3]],
        by: By,
    ) -> LightExport<'a> {
        let radiosity = light.mean_radiosity();
        let row = |(patch, cell): (usize, [u32; 2])| {
            let (of_mesh, face) = (&mesh.patches[patch], mesh.face_of(patch));
            LightRow {
                surface: &scene.surfaces[of_mesh.surface.index()].name,
                group: scene.group(face.surface, face.input_index),
                cell,
                area: of_mesh.area,
                centroid: of_mesh.centroid,
                radiosity: radiosity[patch].map(f64::from),
                irradiance: irradiance[patch].map(f64::from),
                visible: light.visible[patch].into(),
            }
        };
        let rows: Vec<LightRow<'_>> = input_order(scene, mesh).into_iter().map(row).collect();
        let rows = match by {
            By::Patch => rows,
            By::Surface => means(&rows, |row| row.surface),
            By::Group => means(&rows, |row| row.group),
        };
        LightExport { rows, by }
    }

    /// The columns `surface,ia,ib,B_r,B_g,B_b,H_r,H_g,H_b,area,x,y,z,visible,group` of patches;
    /// without place of surfaces and groups, which have one name.
    pub fn to_csv(&self) -> Vec<u8> {
        const LIGHT: [&str; 7] = ["B_r", "B_g", "B_b", "H_r", "H_g", "H_b", "area"];
        let columns: Vec<&str> = match self.by {
            By::Patch => {
                let after = ["x", "y", "z", "visible", "group"];
                [&["surface", "ia", "ib"][..], &LIGHT, &after].concat()
            }
            By::Surface => [&["surface"][..], &LIGHT, &["visible"]].concat(),
            By::Group => [&["group"][..], &LIGHT, &["visible"]].concat(),
        };
        let in_memory = "memory takes all bytes";
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(columns).expect(in_memory);
        for row in &self.rows {
            writer.write_record(self.record(row)).expect(in_memory);
        }
        writer.into_inner().expect(in_memory)
    }

    fn record(&self, row: &LightRow<'_>) -> Vec<String> {
        let name = if self.by == By::Group {
            row.group
        } else {
            row.surface
        };
        let mut record = vec![table_name(name).into_owned()];
        if self.by == By::Patch {
            record.extend(row.cell.map(|index| index.to_string()));
        }
        let single = |number: f64| (number as f32).to_string();
        record.extend(row.radiosity.map(single));
        record.extend(row.irradiance.map(single));
        record.push(single(row.area));
        if self.by == By::Patch {
            record.extend(row.centroid.to_array().map(single));
        }
        record.push(format!("{:.4}", row.visible));
        if self.by == By::Patch {
            record.push(table_name(row.group).into_owned());
        }
        record
    }
}

/// Means by area of the rows of one name, in the order in which names are met.
fn means<'a>(
    rows: &[LightRow<'a>],
    name_of: impl Fn(&LightRow<'a>) -> &'a str,
) -> Vec<LightRow<'a>> {
    let mut sums: Vec<LightRow<'a>> = Vec::new();
    let mut places = HashMap::new();
    for row in rows {
        let place = *places.entry(name_of(row)).or_insert_with(|| {
            sums.push(LightRow {
                area: 0.0,
                centroid: DVec3::ZERO,
                radiosity: [0.0; 3],
                irradiance: [0.0; 3],
                visible: 0.0,
                ..*row
            });
            sums.len() - 1
        });
        let sum = &mut sums[place];
        sum.area += row.area;
        sum.centroid += row.area * row.centroid;
        sum.visible += row.area * row.visible;
        for c in 0..3 {
            sum.radiosity[c] += row.area * row.radiosity[c];
            sum.irradiance[c] += row.area * row.irradiance[c];
        }
    }
    for sum in &mut sums {
        sum.centroid /= sum.area;
        sum.visible /= sum.area;
        sum.radiosity = sum.radiosity.map(|channel| channel / sum.area);
        sum.irradiance = sum.irradiance.map(|channel| channel / sum.area);
    }
    sums
}
