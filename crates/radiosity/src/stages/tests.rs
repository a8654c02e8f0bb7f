//! What stages refuse, and what they keep.

use super::*;
use crate::project::tests::{GOOD, parse};
use crate::{Context, Error, Project};
use radiosity_geometry::{Discretization, Divisions};
use std::sync::Arc;

/// Also by parameters that know nothing of them.
#[test]
fn obstructions_are_not_cut() {
    let square = "F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nV 4 0 1 0\n\
        V 5 0 0 1\nV 6 1 0 1\nV 7 1 1 1\n\
        S 1 1 2 3 4 0 0 0.9 floor\nO 2 5 6 7 0 0 0 0.9 screen\n";
    let project = Project::parse("a.vs3".as_ref(), square).unwrap();
    for params in [&project.params.discretization, &Discretization::uniform(3)] {
        let patches = subdivide(&project.scene, params, Context::default()).unwrap();
        assert!(patches.mesh.faces[1].is_bare());
    }
}

#[test]
fn rules_are_for_surfaces_that_there_are() {
    let mut project = parse(GOOD).unwrap();
    let rules = &mut project.params.discretization.surfaces;
    rules.insert("flor".to_owned(), Divisions::uniform(1));
    let params = &project.params.discretization;
    let error = subdivide(&project.scene, params, Context::default()).err();
    let error = error.unwrap();
    assert_eq!(error.to_string(), "there is no surface `flor`");
    let help = error.remedy().unwrap().to_string();
    assert_eq!(help, "did you mean `floor`?");
}

/// Form factors that somebody holds are not made again; those that nobody holds take no memory.
#[test]
fn form_factors_are_kept_while_somebody_holds_them() {
    let project = parse(GOOD).unwrap();
    let params = &project.params;
    let patches = subdivide(&project.scene, &params.discretization, Context::default()).unwrap();
    let factors = estimate(&patches, &params.form_factors).unwrap();
    let held = factors.made().unwrap();
    assert!(Arc::ptr_eq(&held, &factors.made().unwrap()));
    let dropped = Arc::downgrade(&held);
    drop(held);
    assert!(dropped.upgrade().is_none());
}

#[test]
fn lights_have_factors_in_their_range() {
    let lit = GOOD.replace("reflectance = 0.75", "reflectance = 0.75\nemission = 1");
    let project = parse(&lit).unwrap();
    let params = &project.params;
    let patches = subdivide(&project.scene, &params.discretization, Context::default()).unwrap();
    let factors = estimate(&patches, &params.form_factors).unwrap();
    let solved = solve(&factors, &params.solver).unwrap();
    let mut dimming = Dimming::of(&project.scene);
    dimming.light("white").unwrap().dim = 2.0;
    assert!(solved.relight(&dimming).is_ok());
    dimming.light("white").unwrap().dim = -1.0;
    assert!(matches!(
        solved.relight(&dimming),
        Err(Error::OutOfRange(_))
    ));
}
