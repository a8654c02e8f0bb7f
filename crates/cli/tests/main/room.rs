//! A room that is black where something in it is wrong.

use crate::place::Place;

/// A box of 2 x 3 x 1 with a lamp under its lid, seen from the middle; faces turned inwards.
pub(crate) const BOX: [(&str, [u32; 4]); 5] = [
    ("floor", [0, 1, 3, 2]),
    ("left", [0, 2, 6, 4]),
    ("right", [1, 5, 7, 3]),
    ("front", [0, 4, 5, 1]),
    ("back", [2, 3, 7, 6]),
];

pub(crate) fn corner(k: u32) -> [f64; 3] {
    [
        2.0 * f64::from(k & 1),
        3.0 * f64::from(k >> 1 & 1),
        f64::from(k >> 2),
    ]
}

pub(crate) struct Room {
    pub(crate) inwards: bool,
    pub(crate) emission: f64,
    pub(crate) look_at: [f64; 3],
}

pub(crate) const ORDINARY: Room = Room {
    inwards: true,
    emission: 1.0,
    look_at: [1.0, 3.0, 0.5],
};

pub(crate) fn text_of(room: &Room) -> String {
    let quad = |name: &str, corners: [[f64; 3]; 4], material: &str| {
        format!("[[surfaces]]\nname = \"{name}\"\nmaterial = \"{material}\"\nquad = {corners:?}\n")
    };
    let wall = |&(name, corners): &(&str, [u32; 4])| {
        let mut corners = corners.map(corner);
        if !room.inwards {
            corners.reverse();
        }
        quad(name, corners, "white")
    };
    let lamp = [
        [0.5, 0.5, 1.0],
        [0.5, 2.5, 1.0],
        [1.5, 2.5, 1.0],
        [1.5, 0.5, 1.0],
    ];
    let walls: String = BOX.iter().map(wall).collect();
    format!(
        "[camera]\nposition = [1, 1.5, 0.5]\nlook_at = {:?}\nup = [0.1, 0.2, 1]\n\
         vertical_fov = 40\n\
         [image]\nwidth = 12\nheight = 8\n[discretization]\ndivisions = 2\n\
         [materials.white]\nreflectance = 0.5\n[materials.lamp]\nreflectance = 0\n\
         emission = {}\n{walls}{}",
        room.look_at,
        room.emission,
        quad("lamp", lamp, "lamp"),
    )
}

pub(crate) fn place(room: &Room) -> Place {
    let place = Place::new();
    place.write("room.toml", &text_of(room));
    place
}
