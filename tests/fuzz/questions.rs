//! Random questions about a mechanism, and their form in a file: a line `// hold q0=0.3 free q1` ahead of it.

use linkwork::ask::{AskError, Question};
use linkwork::mechanism::{Configuration, Mechanism, PoseCoordinate};
use linkwork::system::QuestionError;

use crate::generator::Dice;

/// What is held and freed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Asked {
    pub free: Vec<String>,
    pub hold: Vec<(String, f64)>,
}

impl Asked {
    pub fn of(&self, mechanism: &Mechanism) -> Question {
        let question = Question::new(mechanism.clone());
        let question = (self.free.iter()).fold(question, |q, name| q.free(name));
        (self.hold.iter()).fold(question, |q, (name, value)| q.hold(name, *value))
    }

    /// The first line of a file.
    pub fn line(&self) -> String {
        let free = self.free.iter().map(|name| format!(" free {name}"));
        let hold = (self.hold.iter()).map(|(name, value)| format!(" hold {name}={value:?}"));
        format!("//{}", free.chain(hold).collect::<String>())
    }

    /// What [`line`](Self::line) wrote.
    pub fn read(line: &str) -> Self {
        let mut asked = Asked::default();
        let mut words = line.trim_start_matches('/').split_whitespace();
        while let (Some(verb), Some(what)) = (words.next(), words.next()) {
            match (verb, what.split_once('=')) {
                ("free", None) => asked.free.push(what.into()),
                ("hold", Some((name, value))) => {
                    asked.hold.push((name.into(), value.parse().unwrap()))
                }
                _ => panic!("`{verb} {what}` is no part of a question"),
            }
        }
        asked
    }
}

fn value(mechanism: &Mechanism, at: &Configuration<f64>, name: &str) -> f64 {
    match mechanism.joint(name) {
        Some(joint) => at.joints[joint],
        None => {
            let (platform, word) = name.rsplit_once('.').unwrap();
            let platform = mechanism.platform(platform).unwrap();
            PoseCoordinate::from_word(word)
                .unwrap()
                .of(&at.platforms[platform].pose())
        }
    }
}

/// Everything that can be held.
fn coordinates(mechanism: &Mechanism, poses: bool) -> Vec<String> {
    let joints = mechanism.joints().iter().map(|joint| joint.name.clone());
    let platforms = mechanism.platforms().iter().filter(|_| poses);
    let poses = platforms.flat_map(|p| {
        ["x", "y", "z", "roll", "pitch", "yaw"].map(|word| format!("{}.{word}", p.name))
    });
    joints.chain(poses).collect()
}

/// As many random coordinates held as it takes, near where the mechanism is assembled. An error is not sensible if
/// what it proposes does not help.
pub fn asked(mechanism: &Mechanism, dice: &mut Dice) -> Result<Asked, String> {
    let home = mechanism.home();
    let mut asked = Asked {
        free: vec!["actuated".into()],
        hold: Vec::new(),
    };
    let poses = dice.chance(0.3);
    let mut left = coordinates(mechanism, poses);
    let aside = dice.pick(&[0.0, 0.0, 0.02, 0.3]);
    let length = mechanism.characteristic_length();
    // what the file holds is a question too
    if dice.chance(0.2) && Asked::default().of(mechanism).count().is_ok() {
        return Ok(Asked::default());
    }
    let mut moved = |asked: &Asked, name: String| {
        let is_length = match mechanism.joint(&name) {
            Some(joint) => !mechanism.joints()[joint].kind.is_angle(),
            None => ["x", "y", "z"].iter().any(|end| name.ends_with(end)),
        };
        let unit = if is_length { length } else { 1.0 };
        let by = aside * unit * dice.signed();
        let mut with = asked.clone();
        with.hold
            .push((name.clone(), value(mechanism, &home, &name) + by));
        (with, dice.below(1 << 16))
    };
    while !left.is_empty() {
        let (_, place) = moved(&asked, left[0].clone());
        let name = left.swap_remove(place % left.len());
        let (with, _) = moved(&asked, name);
        match with.of(mechanism).count() {
            Ok(_) => return Ok(with),
            Err(AskError::Question(QuestionError::TooFew { hold, .. })) => {
                // what is proposed makes a good question
                let proposed = hold.iter().fold(with.clone(), |asked, name| {
                    let mut with = asked;
                    with.hold
                        .push((name.clone(), value(mechanism, &home, name)));
                    with
                });
                if aside == 0.0
                    && let Err(error) = proposed.of(mechanism).count()
                {
                    return Err(format!(
                        "{} proposes {hold:?}, and then: {error}",
                        with.line()
                    ));
                }
                asked = with;
            }
            Err(AskError::Question(
                QuestionError::TooMany { .. }
                | QuestionError::Dependent { .. }
                | QuestionError::AnglesLocked(_),
            )) => {}
            Err(error) => return Err(format!("{}: {error}", with.line())),
        }
    }
    Ok(asked)
}
