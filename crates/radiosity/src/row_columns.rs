//! What is known of a row of form factors, number by number: one list for tables and for checks.

use radiosity_form_factors::{RowFacts, error_of_rays};

/// A number of a row.
pub(crate) struct Column {
    /// As the head of tables has it.
    pub(crate) name: &'static str,
    /// `None` if the estimator does not tell.
    value: Option<f64>,
    digits: Digits,
}

/// How a number is written.
#[derive(Clone, Copy)]
enum Digits {
    /// A share of what a patch sees.
    Nine,
    /// A share that rays tell to a percent.
    Four,
    /// The size of an error.
    Three,
}

impl Column {
    /// As tables have it; empty if it is not told.
    pub(crate) fn text(&self) -> String {
        match (self.value, self.digits) {
            (None, _) => String::new(),
            (Some(value), Digits::Nine) => format!("{value:.9}"),
            (Some(value), Digits::Four) => format!("{value:.4}"),
            (Some(value), Digits::Three) => format!("{value:.2e}"),
        }
    }
}

/// All that is known of a row, of a patch or a part of so much area, in the order of tables.
pub(crate) fn columns(row: &RowFacts, area: f64) -> [Column; 9] {
    // Whoever adds a field adds its column.
    let RowFacts {
        fronts,
        backs,
        background,
        rays_error,
        visible,
        error,
        missed,
    } = *row;
    // Errors may make more than 1 of what is seen; a share of nothing is none.
    let sky = match area {
        0.0 => 0.0,
        _ => (1.0 - fronts - backs).max(0.0),
    };
    // Rays tell backs and background together, and their error is that of both. Whether what they
    // meet is a back or nothing has an error, too: one share of all rays is off as any other.
    let of_backs = rays_error * error_of_rays(backs) / error_of_rays(backs + background);
    let sky_error = error.map(|error| error + of_backs);
    let column = |name, value, digits| Column {
        name,
        value,
        digits,
    };
    [
        column("fronts", Some(fronts), Digits::Nine),
        column("backs", Some(backs), Digits::Nine),
        column("background", Some(background), Digits::Nine),
        column("rays_error", Some(rays_error), Digits::Three),
        column("sky", Some(sky), Digits::Nine),
        column("sky_error", sky_error, Digits::Three),
        column("error", error, Digits::Three),
        column("visible", Some(visible), Digits::Four),
        column("missed", error.map(|_| missed), Digits::Three),
    ]
}

/// Whether all that is known of a row are numbers.
pub(crate) fn is_finite(row: &RowFacts, area: f64) -> bool {
    let mut columns = columns(row, area).into_iter();
    columns.all(|column| column.value.is_none_or(f64::is_finite))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROW: RowFacts = RowFacts {
        fronts: 0.7,
        backs: 0.2,
        background: 0.1,
        rays_error: 0.01,
        visible: 0.5,
        error: Some(1e-4),
        missed: 2e-5,
    };

    #[test]
    fn every_number_has_to_be_one() {
        assert!(is_finite(&ROW, 1.0));
        let bad = f64::NAN;
        let rows = [
            RowFacts { fronts: bad, ..ROW },
            RowFacts { backs: bad, ..ROW },
            RowFacts {
                background: bad,
                ..ROW
            },
            RowFacts {
                rays_error: bad,
                ..ROW
            },
            RowFacts {
                visible: bad,
                ..ROW
            },
            RowFacts {
                error: Some(f64::INFINITY),
                ..ROW
            },
            RowFacts { missed: bad, ..ROW },
        ];
        assert!(rows.iter().all(|row| !is_finite(row, 1.0)));
    }

    #[test]
    fn closed_rows_have_no_negative_sky() {
        let closed = RowFacts {
            fronts: 1.0 + 3e-5,
            backs: 0.0,
            background: 0.0,
            rays_error: 0.0,
            ..ROW
        };
        let texts = columns(&closed, 2.0).map(|column| column.text());
        assert_eq!(texts[4..6], ["0.000000000", "1.00e-4"]);
    }

    /// Half of all rays meet backs, and the others nothing: that no ray meets a front is sure, but
    /// not how many meet backs.
    #[test]
    fn the_sky_is_as_uncertain_as_the_share_of_backs() {
        let sky_error = |backs: f64, background: f64| {
            let row = RowFacts {
                fronts: 1.0 - backs - background,
                backs,
                background,
                rays_error: error_of_rays(backs + background),
                error: Some(0.0),
                ..ROW
            };
            columns(&row, 1.0)[5].value.unwrap()
        };
        // One of 256 rays; the binomial error of a half.
        assert!((sky_error(0.0, 0.8) * 256.0 - 1.0).abs() < 0.01);
        assert!((sky_error(0.5, 0.5) / (0.5 / 16.0) - 1.0).abs() < 0.01);
    }

    #[test]
    fn covered_rows_have_no_sky_and_untold_errors_are_empty() {
        let texts = |row: &RowFacts, area| columns(row, area).map(|column| column.text());
        let known = texts(&ROW, 2.0);
        let expected = ["0.100000000", "8.85e-3", "1.00e-4", "0.5000", "2.00e-5"];
        assert_eq!(known[4..], expected);
        let untold = RowFacts { error: None, ..ROW };
        let expected = ["0.000000000", "", "", "0.5000", ""];
        assert_eq!(texts(&untold, 0.0)[4..], expected);
    }
}
