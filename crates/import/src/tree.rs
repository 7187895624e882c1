//! Whether links and joints form one tree.

use crate::error::{ImportError, Place, listed};
use crate::robot::{Joint, Link};

/// The link that everything hangs on. Every link has at most one parent already.
pub(crate) fn root(links: &[Link], joints: &[Joint], robot: &Place) -> Result<usize, ImportError> {
    let is_root = |index: &usize| links[*index].parent_joint.is_none();
    let mut roots = (0..links.len()).filter(is_root);
    let Some(root) = roots.next() else {
        return Err(match cycle(links, joints, 0) {
            Some(names) => in_cycle(links, joints, &names),
            None => robot.refuse("no link", "at least one"),
        });
    };
    if let Some(second) = roots.next() {
        let names = [root, second].into_iter().chain(roots).map(|index| links[index].name.as_str());
        let expected = "one link that is no joint's child";
        return Err(links[second].place.refuse(format!("the roots {}", listed(names)), expected));
    }
    let mut is_reached = vec![false; links.len()];
    let mut open = vec![root];
    while let Some(link) = open.pop() {
        is_reached[link] = true;
        open.extend(links[link].child_joints.iter().map(|&joint| joints[joint].child));
    }
    match is_reached.iter().position(|is_reached| !is_reached) {
        Some(lost) => match cycle(links, joints, lost) {
            Some(cycle) => Err(in_cycle(links, joints, &cycle)),
            None => Ok(root),
        },
        None => Ok(root),
    }
}

/// The links of the cycle that going from `start` to the parent again and again ends in, if it does.
fn cycle(links: &[Link], joints: &[Joint], start: usize) -> Option<Vec<usize>> {
    let mut seen = vec![None; links.len()];
    let mut way = Vec::new();
    let mut link = start;
    loop {
        if let Some(since) = *seen.get(link)? {
            return Some(way.split_off(since));
        }
        seen[link] = Some(way.len());
        way.push(link);
        link = joints[links[link].parent_joint?].parent;
    }
}

fn in_cycle(links: &[Link], joints: &[Joint], cycle: &[usize]) -> ImportError {
    let names = listed(cycle.iter().rev().map(|&index| links[index].name.as_str()));
    let first = cycle.iter().filter_map(|&link| links[link].parent_joint).min();
    let place = first.map_or(&links[cycle[0]].place, |joint| &joints[joint].place);
    place.refuse(format!("a cycle of the links {names}"), "a tree")
}
