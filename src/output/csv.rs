//! Rows of numbers as comma-separated values.

use std::borrow::Cow;
use std::io::{self, Write};

use super::quantity::is_long;

/// The values of a row.
pub type Record<'a> = Vec<Value<'a>>;

/// One value of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'a> {
    /// Nothing: not known, or not a number.
    Empty,
    /// A word.
    Text(Cow<'a, str>),
    /// A whole number.
    Count(usize),
    /// A number, written with all its digits.
    Number(f64),
}

impl From<f64> for Value<'_> {
    fn from(value: f64) -> Self {
        match value.is_finite() {
            true => Value::Number(value),
            false => Value::Empty,
        }
    }
}

impl<'a> From<&'a str> for Value<'a> {
    fn from(text: &'a str) -> Self {
        Value::Text(text.into())
    }
}

impl From<String> for Value<'_> {
    fn from(text: String) -> Self {
        Value::Text(text.into())
    }
}

impl From<bool> for Value<'_> {
    fn from(value: bool) -> Self {
        Value::Text(if value { "true" } else { "false" }.into())
    }
}

impl From<usize> for Value<'_> {
    fn from(count: usize) -> Self {
        Value::Count(count)
    }
}

impl<'a, T: Into<Value<'a>>> From<Option<T>> for Value<'a> {
    fn from(value: Option<T>) -> Self {
        value.map_or(Value::Empty, Into::into)
    }
}

/// Writes rows as they come, quoted as RFC 4180 asks, with `\n` after each.
#[derive(Debug)]
pub struct Csv<W: Write> {
    writer: csv::Writer<W>,
    number: String,
}

impl<W: Write> Csv<W> {
    /// Begins with the names of the columns.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn new<S: AsRef<str>>(to: W, columns: impl IntoIterator<Item = S>) -> io::Result<Self> {
        let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(to);
        for column in columns {
            writer.write_field(column.as_ref())?;
        }
        writer.write_record(None::<&[u8]>)?;
        Ok(Csv {
            writer,
            number: String::new(),
        })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn row<'a>(&mut self, values: impl IntoIterator<Item = Value<'a>>) -> io::Result<()> {
        use std::fmt::Write as _;
        for value in values {
            self.number.clear();
            match value {
                Value::Empty => self.writer.write_field("")?,
                Value::Text(text) => self.writer.write_field(text.as_ref())?,
                Value::Count(count) => {
                    let _ = write!(self.number, "{count}");
                    self.writer.write_field(&self.number)?;
                }
                Value::Number(value) => {
                    // a zero has no sign: what is left of one tells of the way a number was computed
                    let value = value + 0.0;
                    let _ = match is_long(value) {
                        true => write!(self.number, "{value:e}"),
                        false => write!(self.number, "{value}"),
                    };
                    self.writer.write_field(&self.number)?;
                }
            }
        }
        self.writer.write_record(None::<&[u8]>)?;
        Ok(())
    }

    /// Where the rows go.
    pub fn target(&self) -> &W {
        self.writer.get_ref()
    }

    /// What is not written yet goes out.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn finish(mut self) -> io::Result<W> {
        self.writer.flush()?;
        self.writer
            .into_inner()
            .map_err(|error| io::Error::other(error.to_string()))
    }
}

/// All rows as one text.
pub fn render<'a>((columns, rows): (Vec<String>, impl Iterator<Item = Record<'a>>)) -> String {
    let written = Csv::new(Vec::new(), columns).and_then(|mut csv| {
        rows.into_iter().try_for_each(|row| csv.row(row))?;
        csv.finish()
    });
    // writing to memory cannot fail, and all that is written is text
    String::from_utf8(written.unwrap_or_default()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_keep_their_digits_and_names_their_commas() {
        let mut csv = Csv::new(Vec::new(), ["mode", "a,b"]).unwrap();
        let row = [Value::from(None::<usize>), Value::from(-0.0)];
        csv.row(row).unwrap();
        csv.row([Value::from(2), Value::from(0.1 + 0.2)]).unwrap();
        csv.row([Value::from("say \"x\""), Value::from(f64::NAN)])
            .unwrap();
        let text = String::from_utf8(csv.finish().unwrap()).unwrap();
        assert_eq!(
            text,
            "mode,\"a,b\"\n,0\n2,0.30000000000000004\n\"say \"\"x\"\"\",\n"
        );
    }
}
