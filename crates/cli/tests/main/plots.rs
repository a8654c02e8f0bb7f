//! Pictures of convergence.

use crate::place::Place;
use std::fs;

#[test]
fn every_method_is_plotted() {
    let place = Place::new();
    let report = place.json("solve room.toml --cache c --plot course.svg");
    assert_eq!(report["outputs"]["plot"], "course.svg");
    let svg = fs::read_to_string(place.path("course.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"));
    for method in [
        "Gauss-Seidel: ",
        "over-relaxation: ",
        "conjugate gradients: ",
    ] {
        assert!(svg.contains(method), "{method}");
    }
    let passes = report["stages"]["solve"]["sweeps"].as_u64().unwrap();
    assert!(
        svg.contains(&format!("over-relaxation: {passes}")),
        "it is the default"
    );
    for wrong in ["--plot course.png", "--plot course.svg --no-cache"] {
        assert_eq!(place.run(&format!("solve room.toml {wrong}")).0, 2);
    }
}
