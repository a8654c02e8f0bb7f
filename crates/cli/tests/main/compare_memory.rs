//! Comparisons under a limit of memory.
#![cfg(target_os = "linux")]

use crate::place::Place;
use std::fs;

/// Three kilobytes asked for three gigabytes.
#[test]
fn small_files_take_little_memory() {
    let place = Place::new();
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 1920, 1080);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header().unwrap();
    writer
        .write_image_data(&vec![127; 1920 * 1080 * 3])
        .unwrap();
    drop(writer);
    fs::write(place.path("plain.png"), &png).unwrap();
    assert_eq!(
        limited(&place, 200_000, "compare plain.png plain.png"),
        (0, String::new())
    );
}

/// Runs with so much memory; exit code and standard error.
fn limited(place: &Place, kilobytes: u32, arguments: &str) -> (i32, String) {
    let limited = format!("ulimit -v {kilobytes}; exec \"$0\" {arguments}");
    let program = env!("CARGO_BIN_EXE_radiosity");
    let mut command = std::process::Command::new("sh");
    let command = command.args(["-c", &limited, program]);
    let output = command.current_dir(place.0.path()).output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    let code = output.status.code();
    (
        code.unwrap_or_else(|| panic!("{kilobytes} kB: {message}")),
        message,
    )
}

/// With any limit from some megabytes more than the program itself takes, a comparison is made or
/// refused, and more memory is no worse.
#[test]
fn pictures_that_do_not_fit_into_memory_are_refused() {
    let place = Place::new();
    let (width, height) = (800, 500);
    let levels = vec![127; 3 * width * height];
    let ppm = [format!("P6 {width} {height} 255\n").as_bytes(), &levels].concat();
    fs::write(place.path("plain.ppm"), ppm).unwrap();
    let mut map = Vec::new();
    let mut encoder = png::Encoder::new(&mut map, width as u32, height as u32);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&levels[..width * height]).unwrap();
    drop(writer);
    fs::write(place.path("map.png"), map).unwrap();
    let plain = "compare plain.ppm plain.ppm";
    for arguments in [
        plain.to_owned(),
        format!("{plain} --difference d.png"),
        format!("{plain} --difference d.pfm"),
        format!("{plain} --regions map.png"),
    ] {
        let limits = (32_000..=72_000).step_by(4_000);
        let found = limits.map(|kilobytes| limited(&place, kilobytes, &arguments));
        let found: Vec<(i32, String)> = found.collect();
        let refused = found.iter().take_while(|(code, _)| *code == 4).count();
        assert!(
            refused > 0 && refused < found.len(),
            "{arguments}: {found:?}"
        );
        for (_, message) in &found[..refused] {
            assert!(message.starts_with("error: "), "{message}");
            assert!(message.contains("of memory, but only"), "{message}");
            assert_eq!(message.lines().count(), 2, "{message}");
        }
        let most = &found[refused - 1].1;
        let expected = "error: comparing plain.ppm with 800 x 500 pixels needs ";
        assert!(most.starts_with(expected), "{most}");
        assert!(
            found[refused..].iter().all(|(code, _)| *code == 0),
            "{arguments}: {found:?}"
        );
    }
}
