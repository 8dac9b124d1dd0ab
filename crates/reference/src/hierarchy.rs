//! The tree of boxes that rays descend: obvhs's compressed 8-wide tree.
//!
//! Its builder clusters what lies nearest, and its traversal remembers 31 levels: both go wrong on regular input.
//! * Boxes that are equal or equally far apart, such as a triangle that is there many times or a row of slats, let the
//!   builder join one pair in each of its rounds: quadratic time and a chain for a tree. So every box grows by a share
//!   of its own, a few millionths of the scene ([`untied`]).
//! * Deeper levels than 31 are silently forgotten, and with them triangles. Real scenes have 5 to 10 levels; what is
//!   deeper in spite of the first measure gets a tree that halves the boxes along the longest side, whose depth is the
//!   binary logarithm of their number: slower to descend, and complete.

use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, DEFAULT_MAX_STACK_DEPTH, node::Bvh2Node, reinsertion::ReinsertionOptimizer};
use obvhs::cwbvh::{CwBvh, bvh2_to_cwbvh::bvh2_to_cwbvh};
use obvhs::{BvhBuildParams, ploc::PlocBuilder};
use scumble_core::pixel_hash;

/// Levels that the traversal of obvhs 0.4 remembers: one less than its stack of 32.
const LEVELS_MAX: usize = 31;
/// Of the compressed tree: it has two bits for it.
const TRIANGLES_PER_LEAF: u32 = 3;
/// Most that a box grows, as a share of the extent of all: some 270 times what `f32` resolves there.
const GROWTH: f32 = 1.6e-5;

/// The tree over boxes; its `primitive_indices` are theirs. Any boxes of finite numbers, also none.
pub fn hierarchy(boxes: &[Aabb]) -> CwBvh {
    // The builder makes no empty tree.
    if boxes.is_empty() {
        return CwBvh::default();
    }
    let boxes = untied(boxes);
    clustered(&boxes).unwrap_or_else(|| widened(&halved(&boxes)))
}

/// The boxes, each larger by its own share of the growth allowed.
fn untied(boxes: &[Aabb]) -> Vec<Aabb> {
    let extent = boxes.iter().fold(Aabb::empty(), |all, one| all.union(one)).diagonal().max_element();
    let grown = |(index, one): (usize, &Aabb)| {
        // Ten bits of the hash to each axis.
        let hash = pixel_hash([index as u32, 0]);
        let share = |shift: u32| (hash >> shift & 0x3ff) as f32 / 1023.0;
        Aabb::new(one.min, one.max + GROWTH * extent * Vec3A::new(share(0), share(10), share(20)))
    };
    boxes.iter().enumerate().map(grown).collect()
}

/// The tree of good quality, `None` where it is too deep.
fn clustered(boxes: &[Aabb]) -> Option<CwBvh> {
    let parameters = BvhBuildParams::medium_build();
    let mut tree = PlocBuilder::with_capacity(boxes.len()).build(
        parameters.ploc_search_distance,
        boxes,
        (0..boxes.len() as u32).collect(),
        parameters.sort_precision,
        parameters.search_depth_threshold,
    );
    if tree.max_depth > DEFAULT_MAX_STACK_DEPTH {
        return None;
    }
    ReinsertionOptimizer::default().run(&mut tree, parameters.reinsertion_batch_ratio, None);
    let wide = widened(&tree);
    (levels(&wide) <= LEVELS_MAX).then_some(wide)
}

/// The tree that halves the number of boxes on each level.
fn halved(boxes: &[Aabb]) -> Bvh2 {
    let around = |indices: &[u32]| indices.iter().fold(Aabb::empty(), |all, &index| all.union(&boxes[index as usize]));
    let mut indices: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut nodes = vec![Bvh2Node::new(around(&indices), 0, 0)];
    let mut open = vec![(0, 0..indices.len())];
    while let Some((node, range)) = open.pop() {
        if range.len() == 1 {
            (nodes[node].prim_count, nodes[node].first_index) = (1, range.start as u32);
            continue;
        }
        let axis = longest_axis(nodes[node].aabb.diagonal());
        let middle = range.len() / 2;
        let place = |index: &u32| boxes[*index as usize].center()[axis];
        indices[range.clone()].select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));

        nodes[node].first_index = nodes.len() as u32;
        let halves = [range.start..range.start + middle, range.start + middle..range.end];
        for half in halves {
            open.push((nodes.len(), half.clone()));
            nodes.push(Bvh2Node::new(around(&indices[half]), 0, 0));
        }
    }
    Bvh2 { nodes, primitive_indices: indices, children_are_ordered_after_parents: true, ..Bvh2::default() }
}

fn longest_axis(size: Vec3A) -> usize {
    (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0)
}

fn widened(tree: &Bvh2) -> CwBvh {
    bvh2_to_cwbvh(tree, TRIANGLES_PER_LEAF, true, false)
}

/// Levels of nodes from the root, which is the first.
fn levels(tree: &CwBvh) -> usize {
    let mut deepest = 0;
    let mut open = vec![(0, 1)];
    while let Some((node, level)) = open.pop() {
        deepest = deepest.max(level);
        let node = &tree.nodes[node];
        let inner = (0..8).filter(|&child| !node.is_child_empty(child) && !node.is_leaf(child));
        open.extend(inner.map(|child| (node.child_node_index(child) as usize, level + 1)));
    }
    deepest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn boxes(count: u32, of: impl Fn(f32) -> [Vec3A; 2]) -> Vec<Aabb> {
        (0..count).map(|i| of(i as f32)).map(|[min, max]| Aabb::new(min, max)).collect()
    }

    /// Boxes that overlap in the origin, as those of a fan's triangles do.
    fn fan(count: u32) -> Vec<Aabb> {
        boxes(count, |i| {
            let tip = Vec3A::new((0.003 * i).cos(), (0.003 * i).sin(), 0.0);
            [tip.min(Vec3A::ZERO), tip.max(Vec3A::ZERO)]
        })
    }

    fn holds_all(tree: &CwBvh, count: u32) -> bool {
        let mut found = tree.primitive_indices.clone();
        found.sort_unstable();
        found.into_iter().eq(0..count)
    }

    #[test]
    fn equal_and_equally_spaced_boxes_have_trees_that_the_traversal_can_remember() {
        let count = 20_000;
        for boxes in [
            fan(count),
            boxes(count, |_| [Vec3A::ZERO, Vec3A::ONE]),
            boxes(count, |i| [Vec3A::splat(i), Vec3A::splat(i)]),
            boxes(count, |i| [Vec3A::X * i, Vec3A::X * i + Vec3A::splat(0.5)]),
        ] {
            let tree = hierarchy(&boxes);
            assert!(levels(&tree) <= LEVELS_MAX && holds_all(&tree, count), "{}", levels(&tree));
        }
    }

    #[test]
    fn a_chain_of_boxes_inside_of_each_other_is_halved() {
        let nested = boxes(2000, |i| [Vec3A::ZERO, Vec3A::splat(i)]);
        assert!(clustered(&nested).is_none(), "the builder makes a chain of them");
        let tree = hierarchy(&nested);
        assert!(levels(&tree) <= LEVELS_MAX && holds_all(&tree, 2000), "{}", levels(&tree));
    }

    #[test]
    fn a_grown_box_holds_the_box_and_is_hardly_larger() {
        let found = untied(&fan(100));
        for (grown, one) in found.iter().zip(fan(100)) {
            assert!(grown.min == one.min && grown.max.cmpge(one.max).all());
            assert!((grown.max - one.max).max_element() <= 2.0 * GROWTH + f32::EPSILON);
        }
    }

    #[test]
    fn a_halved_tree_has_the_depth_of_the_logarithm() {
        for count in [1, 2, 3, 1000, 4096] {
            let tree = halved(&fan(count));
            assert_eq!(tree.depth(0) as u32, 1 + count.next_power_of_two().ilog2(), "{count}");
            tree.validate(&fan(count), false, false);
            assert!(holds_all(&widened(&tree), count));
        }
    }

    #[test]
    fn boxes_side_by_side_have_few_levels() {
        let grid = boxes(4900, |i| [Vec3A::new(i % 70.0, (i / 70.0).floor(), 0.0); 2]);
        assert!(levels(&hierarchy(&grid)) < 10);
    }

    #[test]
    fn no_boxes_have_an_empty_tree() {
        assert!(hierarchy(&[]).nodes.is_empty());
    }
}
