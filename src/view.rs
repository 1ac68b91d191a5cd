//! A mechanism as a page with the solver in it, which `src/page` holds and `src/page/build.sh` makes.

use serde::Serialize;

/// The page with its style, its script and this library for WebAssembly; [`PLACE`] stands for what it shows.
const PAGE: &str = include_str!("page/page.html");
const PLACE: &str = "{mechanism}";

/// Contents of a page.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Viewed {
    /// The name of the file.
    pub file: String,
    /// Its text.
    pub text: String,
    /// Parameters with other values, as expressions.
    pub set: Vec<(String, String)>,
    /// True if the page asks the server that it came from for changes of the file.
    pub watch: bool,
}

impl Viewed {
    /// As JSON without `<`, so that nothing in it ends the block of a page that it stands in.
    pub fn json(&self) -> String {
        let data = serde_json::to_string(self).expect("texts can always be written as JSON");
        data.replace('<', "\\u003c")
    }
}

/// The page that shows a mechanism. The page's security policy runs no script but its own, and the script makes texts of
/// what files say, never elements. Only a page that is watched asks anything of where it came from.
pub fn page(viewed: &Viewed) -> String {
    let (before, after) = (PAGE.split_once(PLACE)).expect("the page has a place for what it shows");
    let before = match viewed.watch {
        true => before.replacen(
            "default-src 'none'",
            "default-src 'none'; connect-src 'self'",
            1,
        ),
        false => before.to_owned(),
    };
    [&before, &viewed.json(), after].concat()
}

/// The mechanisms that the page brings with it: their paths within `mechanisms/`, and their texts.
pub fn shipped() -> Vec<(String, String)> {
    let packed = PAGE.split_once("id=\"files\">").map(|(_, rest)| rest);
    let packed = packed.and_then(|rest| rest.split('<').next());
    let bytes = from_base64(packed.unwrap_or_default());
    serde_json::from_reader(flate2::read::GzDecoder::new(&bytes[..]))
        .expect("src/page/bundle.mjs wrote a list of pairs")
}

/// Bytes written as base64 (RFC 4648, 4).
fn from_base64(text: &str) -> Vec<u8> {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digits = text
        .bytes()
        .filter_map(|c| DIGITS.iter().position(|d| *d == c));
    let (mut bytes, mut waiting, mut bits) = (Vec::with_capacity(text.len() * 3 / 4), 0, 0);
    for digit in digits {
        waiting = waiting << 6 & 0xffff | digit;
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((waiting >> bits) as u8);
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_brings_every_mechanism_as_it_is() {
        let shipped = shipped();
        let mut count = 0;
        for folder in ["", "axes/", "loads/"] {
            let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms");
            for entry in path.join(folder).read_dir().unwrap().flatten() {
                let name = format!("{folder}{}", entry.file_name().to_string_lossy());
                if name.ends_with(".ron") {
                    let text = std::fs::read_to_string(entry.path()).unwrap();
                    let there = shipped.contains(&(name.clone(), text));
                    assert!(there, "{name}: src/page/build.sh makes the page anew");
                    count += 1;
                }
            }
        }
        assert_eq!(shipped.len(), count);
    }

    #[test]
    fn base64_is_read() {
        assert_eq!(from_base64("Zm9vYmFy"), b"foobar");
        assert_eq!(from_base64("Zm9vYg=="), b"foob");
        assert_eq!(from_base64("Zm9vYmE="), b"fooba");
        assert_ne!(from_base64("Zm9vYmE="), b"foobar");
    }

    #[test]
    fn no_text_ends_the_block_it_stands_in() {
        let viewed = Viewed {
            file: "</script><script>alert(1)</script>".into(),
            text: "<!-- <script> {mechanism} \u{202e} \" ' &".into(),
            set: vec![("</script>".into(), "1".into())],
            watch: false,
        };
        let (before, after) = PAGE.split_once(PLACE).unwrap();
        let page = page(&viewed);
        let data = &page[before.len()..page.len() - after.len()];
        assert!(!data.contains('<'));
        let read: serde_json::Value = serde_json::from_str(data).unwrap();
        assert_eq!(read["file"], viewed.file);
        assert_eq!(read["text"], viewed.text);
        assert_eq!(read["set"][0][0], viewed.set[0].0);
    }

    /// Hashes and nothing else let scripts and styles run, and nothing is loaded from anywhere.
    #[test]
    fn the_policy_of_the_page_is_strict() {
        let policy = PAGE
            .split_once("Content-Security-Policy\" content=\"")
            .unwrap()
            .1;
        let policy = policy.split('"').next().unwrap();
        assert!(policy.starts_with("default-src 'none'; script-src 'sha256-"));
        assert!(!policy.contains("unsafe-inline") && !policy.contains("http"));
        assert!(PAGE.len() < 2_850_000, "{} bytes", PAGE.len());
    }
}
