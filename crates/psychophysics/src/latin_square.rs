//! The order of conditions for a participant: a row of a balanced Latin square (Williams 1949).
//!
//! The first row is `0, 1, n-1, 2, n-2, …`, every further row adds 1 modulo n. For an even n the n rows
//! put each condition once into each place and let each one follow each other one once. For an odd n
//! the rows and their reverses, 2 n together, do so twice.

/// The order, a permutation of `0..count`, for participant `number` (any whole number; participants
/// whose numbers follow each other fill the square).
pub(crate) fn balanced_row(count: usize, number: u32) -> Vec<usize> {
    let rows = if count.is_multiple_of(2) { count } else { 2 * count };
    let row = number as usize % rows;
    let zigzag = |place: usize| if place.is_multiple_of(2) { count - place / 2 } else { place.div_ceil(2) };
    let mut order: Vec<usize> = (0..count).map(|place| (zigzag(place) + row) % count).collect();
    if row >= count {
        order.reverse();
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How often each condition stands in each place, and follows each other one, over the whole square.
    fn counts(count: usize) -> (Vec<Vec<usize>>, Vec<Vec<usize>>) {
        let rows = if count.is_multiple_of(2) { count } else { 2 * count };
        let (mut places, mut pairs) = (vec![vec![0; count]; count], vec![vec![0; count]; count]);
        for number in 0..rows as u32 {
            let order = balanced_row(count, number);
            order.iter().enumerate().for_each(|(place, condition)| places[*condition][place] += 1);
            order.windows(2).for_each(|pair| pairs[pair[0]][pair[1]] += 1);
        }
        (places, pairs)
    }

    #[test]
    fn every_condition_stands_in_every_place_and_follows_every_other_equally_often() {
        for count in 1..=9 {
            let times = if count % 2 == 0 { 1 } else { 2 };
            let (places, pairs) = counts(count);
            assert!(places.iter().flatten().all(|found| *found == times), "{count}: {places:?}");
            for (first, row) in pairs.iter().enumerate() {
                for (second, found) in row.iter().enumerate() {
                    assert_eq!(*found, if first == second { 0 } else { times }, "{count}: {first} then {second}");
                }
            }
        }
    }

    #[test]
    fn the_square_of_four_is_the_published_one() {
        let rows: Vec<_> = (0..4).map(|number| balanced_row(4, number)).collect();
        assert_eq!(rows, [[0, 1, 3, 2], [1, 2, 0, 3], [2, 3, 1, 0], [3, 0, 2, 1]]);
    }

    #[test]
    fn numbers_beyond_the_square_start_it_anew() {
        assert_eq!(balanced_row(4, 5), balanced_row(4, 1));
        assert_eq!(balanced_row(3, u32::MAX), balanced_row(3, u32::MAX % 6));
    }
}
