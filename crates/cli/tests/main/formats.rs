//! Formats of pictures.

use crate::place::Place;
use std::fs;

/// All formats of numbers hold the same numbers, and say what they are.
#[test]
fn linear_formats_agree() {
    let place = Place::new();
    let flags = "--show illuminance,light --direct exact --format pfm,exr,hdr,png16";
    place.succeed(&format!("display room.toml --no-cache {flags}"));
    for name in ["room-illuminance-exact", "room-exact"] {
        // HDR has 8 bits for the brightest channel of a pixel, 1/128 of it at worst; the brightest
        // pixels of these pictures are some twice as bright as their mean.
        for (ending, most) in [("exr", 0.0), ("hdr", 2.0 / 1.28)] {
            let report = place.json(&format!(
                "compare out/{name}.{ending} out/{name}.pfm --exposure 1e-6"
            ));
            let percent = report["regions"]["all"]["rmse_percent"].as_f64().unwrap();
            assert!(percent <= most, "{name}.{ending} {percent}");
        }
        for ending in ["exr", "hdr", "16.png"] {
            let bytes = fs::read(place.path(&format!("out/{name}.{ending}"))).unwrap();
            let says = |text: &str| {
                bytes
                    .windows(text.len())
                    .any(|part| part == text.as_bytes())
            };
            assert!(
                says("Solution") && says("room") && says("tolerance 0.01"),
                "{ending}"
            );
        }
        let hdr = fs::read(place.path(&format!("out/{name}.hdr"))).unwrap();
        let unit = if name.contains("illuminance") {
            "lx"
        } else {
            "W/m²/sr"
        };
        assert!(String::from_utf8_lossy(&hdr).contains(&format!("# Unit: {unit}\n")));
    }
}
