//! Arrays as NumPy reads them: `numpy.load("truth.npy")` gives a float32 array of shape (height, width).
//!
//! Format: version 1.0 of *A simple file format for NumPy arrays* (NEP 1): magic, length of the header, a Python
//! dictionary padded so that the data starts at a multiple of 64 bytes, then the values, here little-endian f32 row by
//! row from the top.

/// What every such file starts with.
pub const MAGIC: &[u8] = b"\x93NUMPY";

/// Where the data starts is a multiple of this.
const ALIGNMENT: usize = 64;
/// Magic, version and length of the header.
const PREFIX: usize = 10;

/// The bytes of a file of `values`, as many as `size_px` has pixels.
pub fn npy(values: &[f32], size_px: [u32; 2]) -> Vec<u8> {
    let [width, height] = size_px;
    let dictionary = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({height}, {width}), }}");
    let padded = (PREFIX + dictionary.len() + 1).next_multiple_of(ALIGNMENT) - PREFIX;
    let mut bytes = MAGIC.to_vec();
    bytes.extend([1, 0]);
    // Far below 65536: two numbers of ten digits.
    bytes.extend((padded as u16).to_le_bytes());
    bytes.extend(format!("{dictionary:<width$}\n", width = padded - 1).bytes());
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_header_says_the_shape_and_the_data_is_aligned() {
        for size_px in [[2, 1], [1280, 720], [8192, 8192]] {
            let bytes = npy(&[0.25, 1.0], size_px);
            assert!(bytes.starts_with(b"\x93NUMPY\x01\x00"));
            let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
            let header = std::str::from_utf8(&bytes[PREFIX..PREFIX + length]).unwrap();
            assert!(header.contains(&format!("'shape': ({}, {})", size_px[1], size_px[0])), "{header}");
            assert!(header.ends_with('\n') && (PREFIX + length).is_multiple_of(ALIGNMENT), "{header}");
            assert_eq!(bytes[PREFIX + length..], [0, 0, 0x80, 0x3e, 0, 0, 0x80, 0x3f]);
        }
    }
}
