//! The bodies that `replicate` repeats.

use roxmltree::Node;

use super::include::{MOST_BYTES, Spliced};
use crate::interchange::problem::WrongFile;
use crate::interchange::xml_reader::{Problems, document};

/// The text with all copies written out: R₀ `<frame>` R₁ `<frame>` R₂ … `</frame>` `</frame>`, each copy displaced against the
/// one before, with its number behind the names in it.
pub(crate) fn with_copies(mut spliced: Spliced) -> Result<Spliced, WrongFile> {
    loop {
        let page = document(&spliced.text).map_err(|problem| spliced.wrong(vec![problem]))?;
        let is_replicate = |node: &Node| node.has_tag_name("replicate");
        // the innermost first: the outer ones repeat their copies
        let innermost = |node: &Node| !node.descendants().skip(1).any(|part| is_replicate(&part));
        let nodes = page.descendants().filter(is_replicate);
        let nodes: Vec<Node> = nodes.filter(innermost).collect();
        if nodes.is_empty() {
            return Ok(spliced);
        }
        let mut copied = Spliced::of_files(spliced.files.clone());
        let mut at = 0;
        for node in nodes {
            copied.copy(&spliced, at..node.range().start);
            at = node.range().end;
            let mut problems = Problems(Vec::new());
            problems.needed(node, "count");
            let count = problems.numbers(node, "count").map_or(0, |[n]| n as usize);
            let within = node.range().len().saturating_mul(count);
            if within.saturating_add(copied.text.len()) > MOST_BYTES {
                let (what, help) = ("so many copies", "write fewer of them");
                problems.unsupported::<()>(what, help, node);
            }
            if !problems.0.is_empty() {
                return Err(spliced.wrong(problems.0));
            }
            let displaced = [("pos", "offset"), ("euler", "euler")].map(|(name, given)| {
                let value = node.attribute(given);
                value.map_or(String::new(), |value| format!(" {name}=\"{value}\""))
            });
            let inside = match node.first_child().zip(node.last_child()) {
                Some((first, last)) => first.range().start..last.range().end,
                None => continue,
            };
            let separator = node.attribute("sep").unwrap_or_default();
            let digits = count.to_string().len();
            for i in 0..count {
                if i > 0 {
                    copied.text += &format!("<frame{}>", displaced.concat());
                }
                let mut from = inside.start;
                let named = node.descendants().skip(1);
                for name in named.filter_map(|part| part.attribute_node("name")) {
                    let end = name.range_value().end;
                    copied.copy(&spliced, from..end);
                    copied.text += &format!("{separator}{i:0digits$}");
                    from = end;
                }
                copied.copy(&spliced, from..inside.end);
            }
            copied.text += &"</frame>".repeat(count.saturating_sub(1));
        }
        copied.copy(&spliced, at..spliced.text.len());
        spliced = copied;
    }
}
