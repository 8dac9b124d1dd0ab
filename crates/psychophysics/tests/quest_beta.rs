//! The posterior over beta against an independent computation, and what it finds in simulated people.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scumble_psychophysics::{BetaPosterior, Quest, QuestConfig};

fn data(name: &str) -> String {
    std::fs::read_to_string(format!("{}/tests/data/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// Configuration `log10_cv1` of the reference tables and the responses of their sequence `scripted`.
fn scripted() -> (QuestConfig, Vec<(f64, bool)>) {
    let meta: serde_json::Value = serde_json::from_str(&data("quest_reference_meta.json")).unwrap();
    let config: QuestConfig = serde_json::from_value(meta["configs"]["log10_cv1"].clone()).unwrap();
    let offsets = meta["scripted_offsets"].as_array().unwrap();
    let responses = meta["scripted_responses"].as_array().unwrap();
    let response = |(offset, response): (&serde_json::Value, &serde_json::Value)| {
        (config.t_guess + offset.as_f64().unwrap(), response.as_u64() == Some(1))
    };
    (config, offsets.iter().zip(responses).map(response).collect())
}

#[test]
fn every_beta_of_the_scripted_sequence_has_the_reference_tables_threshold_and_weight() {
    let (config, responses) = scripted();
    let found = BetaPosterior::new(&config, &responses).unwrap();
    let table = data("beta_reference.csv");
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let rows: Vec<[f64; 4]> = reader.deserialize().map(Result::unwrap).collect();
    assert_eq!((rows.len(), found.rows().len()), (16, 16));
    for (expected, row) in rows.iter().zip(found.rows()) {
        let row = [row.beta, row.threshold_mean, row.threshold_sd, row.weight];
        for (expected, found) in expected.iter().zip(row) {
            assert!((found - expected).abs() < 1e-9, "{found} instead of {expected}");
        }
    }
    // The same program's summaries.
    assert!((found.mean() - 1.7467733837555663).abs() < 1e-9);
    assert!((found.sd() - 1.1988910919808655).abs() < 1e-9);
    assert!((found.estimate() - 1.486257142811337).abs() < 1e-9);
    assert!((found.inverse_sd() - 0.18484076233051083).abs() < 1e-9);
    assert_eq!(found.mode(), &found.rows()[0]);
}

#[test]
fn before_the_first_response_every_beta_is_equally_likely() {
    let (config, _) = scripted();
    let prior = BetaPosterior::new(&config, &[]).unwrap();
    assert!(prior.rows().iter().all(|row| (row.probability - 1.0 / 16.0).abs() < 1e-12));
    assert!(prior.rows().iter().all(|row| (row.weight - 1.0 / 16.0).abs() < 1e-12));
}

#[test]
fn a_person_with_another_slope_than_quest_assumed_is_found_out() {
    let (config, _) = scripted();
    for true_beta in [1.7, 3.5, 7.0] {
        let person = Quest::new(QuestConfig { beta: true_beta, ..config }).unwrap();
        let mut quest = Quest::new(config).unwrap();
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut responses = Vec::new();
        for trial in 0..1000 {
            // Half of the trials a little below the threshold: placements alone tell little of beta.
            let intensity = quest.placement() - 0.15 * f64::from(trial % 2);
            let response = person.simulate(intensity, config.t_guess, random.random()).unwrap();
            quest.update(intensity, response).unwrap();
            responses.push((intensity, response));
        }
        let found = BetaPosterior::new(&config, &responses).unwrap();
        // Within two of the steps of a quarter octave.
        assert!((found.estimate() / true_beta).log2().abs() < 0.5, "{true_beta}: {}", found.estimate());
        let total: f64 = found.rows().iter().map(|row| row.probability).sum();
        assert!((total - 1.0).abs() < 1e-12);
    }
}

#[test]
fn ten_thousand_responses_leave_weights() {
    let (config, _) = scripted();
    let responses: Vec<(f64, bool)> = (0..10_000).map(|i| (config.t_guess, i % 5 != 0)).collect();
    let found = BetaPosterior::new(&config, &responses).unwrap();
    assert!(found.estimate().is_finite() && found.sd().is_finite());
}
