//! How the residual falls with each pass, as a picture.

use crate::error::Error;
use plotters::prelude::*;
use radiosity::solver::Params;
use radiosity::stages::Factors;

/// The colours of the methods: of equal lightness, and apart for those who do not tell red from
/// green (Okabe & Ito 2008).
const COLORS: [RGBColor; 3] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
];
const SIZE: (u32, u32) = (720, 420);

/// The residuals of one method.
struct Course {
    name: &'static str,
    color: RGBColor,
    residuals: Vec<f64>,
}

/// Solves by each method, and draws the residual after each pass as SVG.
pub(crate) fn convergence_plot(
    scene: &str,
    factors: &Factors<'_>,
    params: &Params,
) -> Result<String, Error> {
    let mut courses = Vec::new();
    for ((name, params), color) in params.by_each_method().into_iter().zip(COLORS) {
        let residuals = factors.solution(&params)?.report.residuals;
        courses.push(Course {
            name,
            color,
            residuals,
        });
    }
    let mut svg = String::new();
    let drawn = draw(&mut svg, scene, &courses);
    // Drawing fails where a file cannot be written; this is in memory.
    drawn.expect("a string takes every drawing");
    Ok(svg)
}

fn draw(
    svg: &mut String,
    scene: &str,
    courses: &[Course],
) -> Result<(), Box<dyn std::error::Error>> {
    let area = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    area.fill(&WHITE)?;
    let passes = courses.iter().map(|course| course.residuals.len()).max();
    let passes = passes.unwrap_or(0).max(2);
    let all = || {
        courses
            .iter()
            .flat_map(|course| course.residuals.iter().copied())
    };
    let least = all().filter(|&residual| residual > 0.0).fold(0.1, f64::min);
    let floor = 10.0f64.powf(least.log10().floor());
    let top = 10.0f64.powf(all().fold(1.0, f64::max).log10().ceil());
    let mut chart = ChartBuilder::on(&area)
        .caption(
            format!("{scene}: relative residual by pass"),
            ("sans-serif", 18),
        )
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(64)
        .build_cartesian_2d(1..passes, (floor..top).log_scale())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .x_desc("passes over the matrix")
        .y_desc("residual")
        .y_label_formatter(&|residual| format!("{residual:.0e}"))
        .draw()?;
    for course in courses {
        let points = || {
            course
                .residuals
                .iter()
                .enumerate()
                .map(|(k, &r)| (k + 1, r.max(floor)))
        };
        let color = course.color;
        chart
            .draw_series(LineSeries::new(points(), color.stroke_width(2)))?
            .label(format!("{}: {}", course.name, course.residuals.len()))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], color.stroke_width(2)));
        chart.draw_series(points().map(|point| Circle::new(point, 3, color.filled())))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE)
        .border_style(BLACK.mix(0.2))
        .draw()?;
    area.present()?;
    Ok(())
}
