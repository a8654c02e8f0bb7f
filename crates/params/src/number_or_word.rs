//! Parameters that are a number or one word, like `exposure = 1.5` and `exposure = "auto"`; for
//! fields: `#[serde(with = "radiosity_params::number_or_word")]`.

use serde::{Deserializer, Serializer};
use std::fmt;
use std::marker::PhantomData;

/// A number, or one word that stands for the other choice.
pub trait NumberOrWord: Sized {
    /// The word.
    const WORD: &'static str;

    /// From a number, or from the word.
    fn new(number: Option<f64>) -> Self;

    /// The number, unless it is the word.
    fn number(&self) -> Option<f64>;
}

/// Writes the number or the word.
pub fn serialize<T: NumberOrWord, S: Serializer>(
    value: &T,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match value.number() {
        Some(number) => serializer.serialize_f64(number),
        None => serializer.serialize_str(T::WORD),
    }
}

/// Reads either, from a format that describes itself, such as TOML or JSON.
pub fn deserialize<'de, T: NumberOrWord, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<T, D::Error> {
    deserializer.deserialize_any(NumberOrWordVisitor(PhantomData))
}

struct NumberOrWordVisitor<T>(PhantomData<T>);

impl<T: NumberOrWord> serde::de::Visitor<'_> for NumberOrWordVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a number, or \"{}\"", T::WORD)
    }

    fn visit_f64<E: serde::de::Error>(self, number: f64) -> Result<T, E> {
        Ok(T::new(Some(number)))
    }

    fn visit_i64<E: serde::de::Error>(self, number: i64) -> Result<T, E> {
        Ok(T::new(Some(number as f64)))
    }

    fn visit_u64<E: serde::de::Error>(self, number: u64) -> Result<T, E> {
        Ok(T::new(Some(number as f64)))
    }

    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<T, E> {
        let unexpected = serde::de::Unexpected::Str(word);
        if word == T::WORD {
            Ok(T::new(None))
        } else {
            Err(E::invalid_value(unexpected, &self))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::{Deserialize, Serialize};

    #[derive(Debug, PartialEq)]
    struct Speed(Option<f64>);

    impl NumberOrWord for Speed {
        const WORD: &'static str = "fast";

        fn new(number: Option<f64>) -> Speed {
            Speed(number)
        }

        fn number(&self) -> Option<f64> {
            self.0
        }
    }

    #[derive(Debug, PartialEq, Serialize, Deserialize)]
    struct Table {
        #[serde(with = "super")]
        speed: Speed,
    }

    #[test]
    fn both_are_written_as_they_are_read() {
        for text in ["{\"speed\":1.5}", "{\"speed\":\"fast\"}"] {
            let table: Table = serde_json::from_str(text).unwrap();
            assert_eq!(serde_json::to_string(&table).unwrap(), text);
        }
        let whole: Table = serde_json::from_str("{\"speed\":2}").unwrap();
        assert_eq!(whole.speed, Speed(Some(2.0)));
        let error = serde_json::from_str::<Table>("{\"speed\":\"slow\"}").unwrap_err();
        assert!(
            error.to_string().contains("a number, or \"fast\""),
            "{error}"
        );
    }
}
