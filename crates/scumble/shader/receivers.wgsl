// Where the receivers of a light with cascades are: their box across the light by band of view depth, for the next fit
// (`scumble_core::Seen`). Bits of positive floats keep their order: without the lowest 22, those of a view depth are its band,
// two an octave. A box is four minima, of x, y, -x and -y.

struct LightReceivers {
    minima: array<array<atomic<u32>, 4>, MEASURE_BANDS>,
}

const MEASURE_BANDS: u32 = 32u;
// Bits of a view depth that no band tells apart, and what the rest is of the first band's, 1/16 m.
const MEASURE_BAND_SHIFT: u32 = 22u;
const MEASURE_BAND_FIRST: u32 = 246u;
// Above the bits of every number, in order.
const MEASURE_NOWHERE: u32 = 0xffffffffu;

var<workgroup> group_receivers: array<atomic<u32>, 4u * MEASURE_BANDS>;

// Bits of a number in its order. CPU inverse: `number_of` of `seen.rs`.
fn ordered(number: f32) -> u32 {
    let bits = bitcast<u32>(number);
    return select(bits | 0x80000000u, ~bits, bits >= 0x80000000u);
}

// CPU twin: `scumble_core::Seen::band_depths`.
fn band_of(here: vec3f) -> u32 {
    let view_depth = max(dot(here - measure.eye, measure.forward), 0.0);
    let band = max(bitcast<u32>(view_depth) >> MEASURE_BAND_SHIFT, MEASURE_BAND_FIRST) - MEASURE_BAND_FIRST;
    return min(band, MEASURE_BANDS - 1u);
}

// Adds minima of x, y, -x and -y to the boxes of the group.
fn add_receivers(band: u32, minima: vec4f) {
    for (var i = 0u; i < 4u; i++) {
        atomicMin(&group_receivers[4u * band + i], ordered(minima[i]));
    }
}

// Looks at four of the pixels that `first` stands for, one in each quarter of their rows and of their columns: a surface
// that ends along either, as ground does at the horizon, is not cut short by more than a quarter of the stride.
fn find_receivers(light: u32, first: vec2i, size: vec2i) {
    var band = MEASURE_BANDS;
    var minima = vec4f(0.0);
    for (var i = 0u; i < 4u; i++) {
        let offset = vec2u(i, (2u * i + 1u) % 5u) * measure.stride / 4u;
        let pixel = min(first + vec2i(offset), size - 1);
        if depth_at(pixel) >= 1.0 {
            continue;
        }
        let here = surface_at(pixel);
        let across = vec2f(dot(shadow_lights.lights[light].across_x, here), dot(shadow_lights.lights[light].across_y, here));
        let here_band = band_of(here);
        if here_band == band {
            minima = min(minima, vec4f(across, -across));
            continue;
        }
        if band < MEASURE_BANDS {
            add_receivers(band, minima);
        }
        band = here_band;
        minima = vec4f(across, -across);
    }
    if band < MEASURE_BANDS {
        add_receivers(band, minima);
    }
}

fn start_receivers(index: u32) {
    for (var place = index; place < 4u * MEASURE_BANDS; place += MEASURE_GROUP) {
        atomicStore(&group_receivers[place], MEASURE_NOWHERE);
    }
}

fn write_receivers(light: u32, index: u32) {
    for (var place = index; place < 4u * MEASURE_BANDS; place += MEASURE_GROUP) {
        let minimum = atomicLoad(&group_receivers[place]);
        if minimum < MEASURE_NOWHERE {
            atomicMin(&measured.receivers[light].minima[place / 4u][place % 4u], minimum);
        }
    }
}
