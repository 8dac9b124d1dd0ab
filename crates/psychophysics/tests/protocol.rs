//! The protocol: its file and what it refuses.

use scumble_psychophysics::{Experiment, Protocol};

#[test]
fn a_protocol_survives_its_file() {
    let protocol = Protocol::two_alternative();
    let file = serde_json::to_string_pretty(&protocol).unwrap();
    assert_eq!(serde_json::from_str::<Protocol>(&file).unwrap(), protocol);
}

#[test]
fn a_name_on_the_command_line_gives_its_protocol_and_another_one_the_list() {
    assert_eq!(Protocol::named("two-alternative").unwrap(), Protocol::two_alternative());
    let error = Protocol::named("three-alternative").unwrap_err();
    assert_eq!(
        error.to_string(),
        "protocol is three-alternative; allowed is published, two-alternative, yes-no, or a file that ends in .toml"
    );
}

#[test]
fn a_misspelt_key_is_refused_by_name() {
    let file = serde_json::to_string(&Protocol::two_alternative()).unwrap();
    let file = file.replace("trials_max", "trial_max");
    let error = serde_json::from_str::<Protocol>(&file).unwrap_err();
    assert!(error.to_string().contains("trial_max"));
}

#[test]
fn the_prior_is_three_texels_and_the_intensity_the_negative_logarithm_of_the_ratio() {
    let staircase = Protocol::two_alternative().staircase_at(3.0).unwrap();
    assert!((staircase.mean() + 3f64.log10()).abs() < 1e-12);
    assert!((staircase.sd() - 0.6).abs() < 1e-3);
}

#[test]
fn every_parameter_out_of_range_is_refused_by_name_before_a_session_starts() {
    type Break = fn(&mut Protocol);
    let broken: [(&str, Break); 20] = [
        ("conditions.patterns", |p| p.conditions.patterns.clear()),
        ("conditions.contrasts", |p| p.conditions.contrasts.clear()),
        ("conditions.texels_px", |p| p.conditions.texels_px.clear()),
        ("conditions.contrasts", |p| p.conditions.contrasts[0] = 0.0),
        ("conditions.contrasts", |p| p.conditions.contrasts[0] = 1.5),
        ("practice.contrast", |p| p.practice.contrast = f64::NAN),
        ("practice.ratios", |p| p.practice.ratios[0] = -1.0),
        ("conditions.texels_px", |p| p.conditions.texels_px[0] = f64::NAN),
        ("conditions.texels_px", |p| p.conditions.texels_px[0] = 240.0),
        ("practice.texel_px", |p| p.practice.texel_px = 0.0),
        ("pictures.width_px", |p| p.pictures.width_px = 0),
        ("pictures.height_px", |p| p.pictures.height_px = 100_000),
        ("pictures.ratio_min", |p| p.pictures.ratio_min = 0.0),
        ("schedule.trials_min", |p| p.schedule.trials_min = 0),
        ("schedule.trials_max", |p| p.schedule.trials_max = 9),
        ("staircase.prior_ratios", |p| p.staircase.prior_ratios[0] = -3.0),
        ("staircase.prior_sd_log10", |p| p.staircase.prior_sd_log10 = 0.0),
        ("staircase.threshold_probability", |p| p.staircase.threshold_probability = 0.4),
        ("convergence.interval_width_log10", |p| {
            p.convergence.interval_width_log10 = 0.0;
        }),
        ("convergence.edge_distance_log10", |p| {
            p.convergence.edge_distance_log10 = f64::NAN;
        }),
    ];
    for (name, break_it) in broken {
        let mut protocol = Protocol::two_alternative();
        break_it(&mut protocol);
        let message = Experiment::new(protocol, 1, 0).unwrap_err().to_string();
        assert!(message.starts_with(&format!("{name} is")), "{name}: {message}");
    }
}
