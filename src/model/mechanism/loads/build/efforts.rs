//! Springs, given forces and friction from a file.

use super::*;

/// The field of an effort of this unit, and the field of the other.
fn effort_fields(unit: SiUnit) -> [&'static str; 2] {
    match unit == SiUnit::NEWTON_METRE {
        true => ["moment", "force"],
        false => ["force", "moment"],
    }
}

fn needed(unit: SiUnit) -> &'static str {
    match unit == SiUnit::NEWTON_METRE {
        true => "`moment`, as its joint turns",
        false => "`force`, as it acts along a line",
    }
}

impl Reading<'_> {
    pub(super) fn spring(
        &mut self,
        name: &Spanned<String>,
        file: &LoadDescription,
    ) -> Option<Spring> {
        let along = self.along(name, file)?;
        let [coordinate, effort] = self.units(&along);
        let mut entry =
            |field: &str, unit: SiUnit, what: Option<&'static str>| match (file.field(field), what)
            {
                (Some(LoadField::Entry(entry)), Some(what)) => self.positive(entry, unit, what),
                (Some(LoadField::Entry(entry)), None) => self.number(entry, unit),
                _ => 0.0,
            };
        let rest = match along {
            Along::Points(_) => entry("length", coordinate, Some("the free length")),
            Along::Joint(_) => entry("rest", coordinate, None),
        };
        let yes = |field: &str| matches!(file.field(field), Some(LoadField::Yes(true)));
        let only = [(yes("tension_only"), 1.0), (yes("compression_only"), -1.0)];
        Some(Spring {
            name: name.value.clone(),
            along,
            stiffness: entry("stiffness", per(effort, coordinate), Some("the stiffness")),
            rest,
            preload: entry("preload", effort, None),
            damping: entry(
                "damping",
                per(effort, coordinate).times(SiUnit::SECOND),
                Some("the damping"),
            ),
            only: only.into_iter().find(|(yes, _)| *yes).map(|(_, sign)| sign),
        })
    }

    pub(super) fn force(
        &mut self,
        name: &Spanned<String>,
        file: &LoadDescription,
    ) -> Option<GivenForce> {
        let owned = name.value.clone();
        let table = match (file.field("table"), file.field("over")) {
            (Some(LoadField::Table(rows)), Some(LoadField::Entry(over))) => {
                Some((self.argument(over)?, self.table(rows)?))
            }
            (None, None) => None,
            (Some(LoadField::File(file)), _) => {
                let reason = "only a mechanism file on disk has files beside it".into();
                let file_name = file.value.clone();
                let problem = LoadProblem::TableFile {
                    file: file_name,
                    reason,
                };
                self.note(problem, &file.span);
                return None;
            }
            _ => {
                let fields = "`table` and `over` together";
                let name = owned;
                self.note(LoadProblem::Needs { name, fields }, &file.span);
                return None;
            }
        };
        let factor = |value: Option<Expression<Measured>>| {
            let table = table.clone();
            Some(GivenValue {
                value: value?,
                table,
            })
        };
        let Some(LoadField::Name(at)) = file.field("at") else {
            let along = self.along(name, file)?;
            let [_, effort] = self.units(&along);
            let [wanted, other] = effort_fields(effort);
            let value = match (file.field(wanted), file.field(other)) {
                (Some(LoadField::Entry(entry)), None) => match table {
                    // its values may be pressures, say: the product is the force
                    Some(_) => self.argument(entry),
                    None => self.given(entry, effort),
                },
                (None, None) if table.is_some() => Some(Expression::number(1.0)),
                _ => {
                    let (name, fields) = (owned.clone(), needed(effort));
                    self.note(LoadProblem::Needs { name, fields }, &file.span);
                    None
                }
            };
            let on = GivenEffort::Along(along, Box::new(factor(value)?));
            return Some(GivenForce { name: owned, on });
        };
        let point = self.point(at)?;
        if self.mechanism.body(point.frame) == Body::Ground {
            self.note(LoadProblem::OnGround { name: owned }, &at.span);
            return None;
        }
        let mut wrench = Vec::new();
        for (field, unit) in [("force", SiUnit::NEWTON), ("moment", SiUnit::NEWTON_METRE)] {
            match file.field(field) {
                Some(LoadField::Vector(vector)) => {
                    let parts = vector.iter().map(|entry| match table {
                        Some(_) => self.argument(entry),
                        None => self.given(entry, unit),
                    });
                    wrench.extend(parts.map(&factor));
                }
                None => wrench.extend((0..3).map(|_| factor(Some(Expression::number(0.0))))),
                Some(_) => {
                    let (name, fields) = (owned, "a vector as `force` or `moment`");
                    self.note(LoadProblem::Needs { name, fields }, &file.span);
                    return None;
                }
            }
        }
        let wrench = wrench.into_iter().collect::<Option<Vec<GivenValue>>>()?;
        let wrench: [GivenValue; 6] = wrench.try_into().ok()?;
        let follows = match file.field("along") {
            Some(LoadField::Name(name)) => name.value != GROUND,
            _ => false,
        };
        let on = GivenEffort::At {
            point,
            wrench: Box::new(wrench),
            follows,
        };
        Some(GivenForce { name: owned, on })
    }

    pub(super) fn friction(
        &mut self,
        name: &Spanned<String>,
        file: &LoadDescription,
    ) -> Option<Friction> {
        let Along::Joint(joint) = self.along(name, file)? else {
            let (name, fields) = (name.value.clone(), "`joint`");
            self.note(LoadProblem::Needs { name, fields }, &file.span);
            return None;
        };
        let [_, effort] = self.units(&Along::Joint(joint));
        let turns = self.mechanism.joints()[joint].kind.is_angle();
        let [wanted, other] = effort_fields(effort);
        let constant = file.field(wanted);
        let mut entry = |field: Option<&LoadField>, unit, what| match field {
            Some(LoadField::Entry(entry)) => self.positive(entry, unit, what),
            _ => 0.0,
        };
        let friction = Friction {
            name: name.value.clone(),
            joint,
            constant: entry(constant, effort, "friction"),
            coefficient: entry(file.field("coefficient"), SiUnit::ONE, "the coefficient"),
            radius: entry(file.field("radius"), SiUnit::METRE, "the radius"),
        };
        let fields = match (constant, friction.coefficient > 0.0) {
            _ if file.field(other).is_some() => needed(effort),
            (None, false) if file.field("coefficient").is_none() => {
                "`force`, `moment` or `coefficient`"
            }
            (_, true) if turns && file.field("radius").is_none() => "the `radius` of the pin",
            _ => return Some(friction),
        };
        let name = name.value.clone();
        self.note(LoadProblem::Needs { name, fields }, &file.span);
        None
    }
}
