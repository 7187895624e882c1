//! Which links are neighbours, which may start inside the keep-out sphere, and that what a refusal
//! names as the way out is one.

use std::path::{Path, PathBuf};

use righting_scenario::bodies::{ArmPart, Piece};
use righting_scenario::collision::Between;
use righting_scenario::{Error, Scenario, file};
use righting_test_support::{scenarios, shipped};

fn system(path: PathBuf) -> file::System {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Rods one after the other, each turned by a quarter about its own axis; a short one moves nothing
/// far.
fn arm(lengths_m: &[f64], clearance_m: f64) -> Scenario {
    let mut file = shipped("slew_4dof").resolved().clone();
    let mut system = system(scenarios().join("systems/xlink_4dof.json"));
    let row = file::Link {
        alpha_deg: 90.0,
        theta_deg: 20.0,
        angle_min_deg: None,
        angle_max_deg: None,
        body_exempt: false,
        ..system.links[1].clone()
    };
    system.links = lengths_m.iter().map(|&a_m| file::Link { a_m, ..row.clone() }).collect();
    system.base.keep_out_radius_m = Some(0.0);
    file.initial =
        file::Initial { joint_angles_deg: vec![0.0; lengths_m.len()], ..file::Initial::default() };
    file.system = file::SystemReference::Inline(Box::new(system));
    file.collision.clearance_m = Some(clearance_m);
    Scenario::from_file(file, Path::new("arm.json")).unwrap()
}

/// Pairs of links that keep apart.
fn links_apart(scenario: &Scenario) -> Vec<(usize, usize)> {
    let pairs = scenario.collision().pairs.iter();
    pairs
        .filter_map(|pair| match pair.between {
            Between::Pieces(a, b) => Some((link(a), link(b))),
            _ => None,
        })
        .collect()
}

/// Links that keep away from the keep-out sphere.
fn links_off_body(scenario: &Scenario) -> Vec<usize> {
    let pairs = scenario.collision().pairs.iter();
    pairs
        .filter_map(|pair| match pair.between {
            Between::Body(piece) => Some(link(piece)),
            _ => None,
        })
        .collect()
}

fn link(piece: Piece) -> usize {
    let Piece { part: ArmPart::Link(link), shape: None } = piece else { panic!("{piece}") };
    link
}

#[test]
fn links_that_cannot_be_apart_by_the_clearance_share_a_joint() {
    let pairs = |lengths_m: &[f64], clearance_m| links_apart(&arm(lengths_m, clearance_m));
    let all = [(0, 2), (0, 3), (1, 3)];
    assert_eq!(pairs(&[0.5, 0.5, 0.5, 0.5], 0.01), all);
    // A rounding of zero is zero, whatever the clearance.
    for noise in [0.0, 1e-12, -3e-13] {
        assert_eq!(pairs(&[0.5, noise, 0.5, 0.5], 0.01), [(0, 3)]);
        assert_eq!(pairs(&[0.5, noise, 0.5, 0.5], 0.0), [(0, 3)]);
    }
    // A short link keeps clear of others itself.
    assert_eq!(pairs(&[0.5, 6e-4, 0.5, 0.5], 0.01), [(0, 3), (1, 3)]);
    assert_eq!(pairs(&[0.5, 6e-4, 0.5, 0.5], 5e-4), all);
    // Short links add up.
    assert_eq!(pairs(&[0.5, 6e-3, 3e-3, 0.5], 0.01), [(0, 2); 0]);
    assert_eq!(pairs(&[0.5, 6e-3, 5e-3, 0.5], 0.01), [(0, 3)]);
    assert_eq!(pairs(&[0.5, 0.01, 0.5, 0.5], 0.01), [(0, 3), (1, 3)]);

    // Rounding is not worth a word, a clearance that is not kept is.
    assert_eq!(arm(&[0.5, 1e-12, 0.5, 0.5], 0.01).notes(), [""; 0]);
    assert_eq!(
        arm(&[0.5, 6e-4, 0.5, 0.5], 0.01).notes(),
        [
            "collision.clearance_m: links 1 and 3 are never farther apart than what is between them, \
          0.0006 m: no clearance is kept between them"
        ]
    );
    assert_eq!(links_off_body(&arm(&[0.5, 1e-12, 0.5, 0.5], 0.01)), [0, 2, 3]);
}

/// The arm that starts folded against its base.
fn folded(change: impl FnOnce(&mut file::Scenario, &mut file::System)) -> Result<Scenario, Error> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/tecsas_raw.json");
    let mut system = system(data);
    system.project_inertias = true;
    let mut file = shipped("slew_4dof").resolved().clone();
    file.initial = file::Initial {
        joint_angles_deg: vec![0.0, 30.0, 0.0, 60.0, 0.0, -30.0, 0.0],
        ..file::Initial::default()
    };
    change(&mut file, &mut system);
    file.system = file::SystemReference::Inline(Box::new(system));
    Scenario::from_file(file, Path::new("folded.json"))
}

#[test]
fn what_the_refusal_of_a_start_names_is_a_way_out() {
    assert_eq!(
        folded(|_, _| ()).unwrap_err().to_string(),
        "folded.json: initial.joint_angles_deg: found a start with link 2 0.204873 m from the base's \
         center of mass, link 3 0.186899 m from the base's center of mass, expected at least 0.31 m, \
         keep-out radius and clearance (or set system.links[1].body_exempt and \
         system.links[2].body_exempt)"
    );
    let exempting = |links: &'static [usize]| {
        folded(|_, system| links.iter().for_each(|&link| system.links[link].body_exempt = true))
    };
    // One of them is not enough, and the refusal goes on to the other.
    let refused = exempting(&[1]).unwrap_err().to_string();
    assert!(refused.ends_with("(or set system.links[2].body_exempt)"), "{refused}");
    let followed = exempting(&[1, 2]).unwrap();
    let notes: Vec<&String> =
        followed.notes().iter().filter(|note| note.contains("body_exempt")).collect();
    assert_eq!(
        notes,
        [
            "system.links[1].body_exempt: link 2 starts inside the keep-out sphere and can leave it: it \
             is not kept away from the base anywhere",
            "system.links[2].body_exempt: link 3 starts inside the keep-out sphere and can leave it: it \
             is not kept away from the base anywhere"
        ]
    );
    assert_eq!(links_off_body(&followed), [0, 3, 4, 5, 6]);
    // One that starts outside needs none, and gets none.
    assert_eq!(
        exempting(&[1, 2, 4]).unwrap_err().to_string(),
        "folded.json: system.links[4].body_exempt: found true, expected false: link 5 starts 0.336777 m \
         from the base's center of mass, outside the keep-out sphere with its clearance, 0.31 m"
    );
}

#[test]
fn a_smaller_clearance_is_named_where_it_is_enough() {
    let with = |clearance_m: f64| {
        folded(|file, system| {
            system.base.keep_out_radius_m = Some(0.18);
            file.collision.clearance_m = Some(clearance_m);
        })
    };
    let refused = with(0.01).unwrap_err().to_string();
    let way_out = "(or set system.links[2].body_exempt, or collision.clearance_m to 0.00689)";
    assert!(refused.ends_with(way_out), "{refused}");
    with(0.00689).unwrap();
}

/// Less clearance would put link 3 outside, but link 2, which is exempt, too.
#[test]
fn no_way_out_is_named_that_is_none() {
    let exempt = |links: &'static [usize], keep_out_m: f64, clearance_m: f64| {
        folded(move |file, system| {
            links.iter().for_each(|&link| system.links[link].body_exempt = true);
            system.base.keep_out_radius_m = Some(keep_out_m);
            file.collision.clearance_m = Some(clearance_m);
        })
    };
    // Link 2 is at 0.204873 m, link 3 at 0.186899 m.
    let refused = exempt(&[1], 0.18, 0.03).unwrap_err().to_string();
    assert!(refused.ends_with("(or set system.links[2].body_exempt)"), "{refused}");
    let lowered = exempt(&[1], 0.18, 0.0068).unwrap_err().to_string();
    assert!(
        lowered.contains("system.links[1].body_exempt: found true, expected false"),
        "{lowered}"
    );
    exempt(&[1, 2], 0.18, 0.03).unwrap();
}

#[test]
fn a_link_that_never_leaves_is_exempt_without_a_word() {
    let scenario = shipped("slew_4dof");
    assert!(scenario.system().body_exempt[0] && scenario.notes().is_empty());
}
