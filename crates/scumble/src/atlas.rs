//! Where maps lie on one square page: rows of rectangles, the highest first.
//!
//! First fit by decreasing height (Coffman and others 1980): a rectangle goes onto the first row with room for it, or opens a
//! row below the last. Filters never read beyond a map's rectangle, so rectangles touch.

/// Places of rectangles of these widths and heights on a page of `side`, in their order: the corner nearest to the page's. `None`
/// where they do not fit.
///
/// ```text
/// +-----------+-----+---+
/// |           |  1  | 3 |   a row is as high as its first
/// |     0     +-----+---|
/// |           |         |
/// +-------+---+---+-----|
/// |   2   |   4   |     |
/// +-------+-------+     |
/// ```
pub fn pack(side: u32, sizes: &[[u32; 2]]) -> Option<Vec<[u32; 2]>> {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by_key(|&i| std::cmp::Reverse(sizes[i][1]));
    // Top of each row, and how much of its width is taken.
    let mut rows: Vec<[u32; 2]> = Vec::new();
    let mut bottom = 0;
    let mut places = vec![[0; 2]; sizes.len()];
    for i in order {
        let [width, height] = sizes[i];
        let row = match rows.iter().position(|[_, taken]| taken.saturating_add(width) <= side) {
            Some(row) => row,
            None if width <= side && bottom + height <= side => {
                rows.push([bottom, 0]);
                bottom += height;
                rows.len() - 1
            }
            None => return None,
        };
        let [top, taken] = &mut rows[row];
        places[i] = [*taken, *top];
        *taken += width;
    }
    Some(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_lie_in_rows_from_the_highest_down() {
        let sizes = [[5, 6], [3, 3], [4, 3], [2, 3], [4, 2]];
        assert_eq!(pack(10, &sizes), Some(vec![[0, 0], [5, 0], [0, 6], [8, 0], [4, 6]]));
    }

    #[test]
    fn rectangles_touch_and_never_meet() {
        // Sizes by turns, without a common factor.
        let sizes: Vec<[u32; 2]> = (0..24).map(|i| [8 + 13 * (i % 7), 8 + 11 * (i % 5)]).collect();
        let places = pack(256, &sizes).expect("half of the page is free");
        for i in 0..sizes.len() {
            assert!((0..2).all(|axis| places[i][axis] + sizes[i][axis] <= 256));
            for j in 0..i {
                let apart = |axis: usize| {
                    places[i][axis] + sizes[i][axis] <= places[j][axis]
                        || places[j][axis] + sizes[j][axis] <= places[i][axis]
                };
                assert!(apart(0) || apart(1), "{i} {j}");
            }
        }
    }

    #[test]
    fn a_page_is_used_to_its_last_texel_and_no_further() {
        assert_eq!(pack(16, &[[8, 8]; 4]), Some(vec![[0, 0], [8, 0], [0, 8], [8, 8]]));
        assert_eq!(pack(16, &[[8, 8]; 5]), None);
        assert_eq!(pack(16, &[[16, 16]]), Some(vec![[0, 0]]));
        assert_eq!(pack(16, &[[17, 1]]), None);
        assert_eq!(pack(16, &[[u32::MAX, 1], [4, 4]]), None);
        assert_eq!(pack(16, &[]), Some(Vec::new()));
    }
}
