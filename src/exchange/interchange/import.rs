//! URDF, MJCF or SDF → description.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::mjcf::{self, Files, NotRead};
use super::names::fit;
use super::pins::on_one_pin;
use super::problem::{ImportProblem, ImportProblemKind, WrongFile};
use super::remark::Remark;
use super::rods::without_rods;
use super::sdf;
use super::tree::Tree;
use super::unroll::{Unrolled, describe};
use super::urdf;
use super::xml_reader::{document, strict};
use crate::description::{Convention, Description, LoadError, load_text, nearest};

/// Settings of an import.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportSettings {
    /// The convention of the tables.
    pub convention: Convention,
    /// Links and sites whose frames are kept under their names.
    pub frames: Vec<String>,
    /// True if the frames of all links and sites are kept.
    pub all_frames: bool,
    /// Folders besides that of the model from which included files may be read.
    pub include_from: Vec<PathBuf>,
}

/// A description made from a file of another program.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The mechanism.
    pub description: Description,
    /// Remarks.
    pub remarks: Vec<Remark>,
    /// The names of all links and sites, to which a file of loops can refer.
    pub links: Vec<String>,
    /// The home values of the file that were outside the limits, in m or rad, by joint.
    pub outside: Vec<(String, f64)>,
}

/// Reasons for which a file of another program could not be read.
#[derive(Debug, Error)]
pub enum ImportError {
    /// The file could not be opened, or is not text.
    #[error(transparent)]
    Unreadable(LoadError),
    /// The file has problems.
    #[error(transparent)]
    Wrong(WrongFile),
}

/// Reads a URDF, MJCF or SDF file; the latter two with the files they include, which lie in its folder or in those of
/// [`ImportSettings::include_from`].
///
/// `loops` is the description of a file that closes loops: its closures, chains and platforms refer to links and
/// sites by their names, its joints override role, home and limits of the imported ones.
///
/// # Errors
/// If a file cannot be read or has problems.
pub fn load(
    path: &Path,
    loops: Option<&Description>,
    settings: &ImportSettings,
) -> Result<Imported, ImportError> {
    let text = load_text(path).map_err(ImportError::Unreadable)?;
    load_beside(path, &text, loops, settings)
}

/// As [`load`], for a text that stands for the file at a path.
///
/// # Errors
/// If an included file cannot be read, or one has problems.
pub fn load_beside(
    path: &Path,
    text: &str,
    loops: Option<&Description>,
    settings: &ImportSettings,
) -> Result<Imported, ImportError> {
    let folder = path.parent().map(Path::to_owned).unwrap_or_default();
    let files = |name: &str| {
        let path = folder.join(name);
        if !is_within(&path, &folder, &settings.include_from) {
            return Err(NotRead::Outside);
        }
        load_text(path).map_err(|error| {
            NotRead::Failed(match error {
                LoadError::Unreadable { error, .. } => error.to_string(),
                other => other.to_string(),
            })
        })
    };
    let name = path.display().to_string();
    import(&name, text, &files, loops, settings).map_err(ImportError::Wrong)
}

/// True if a file lies in one of these folders, links followed. Of a file that does not exist the folder decides.
fn is_within(path: &Path, folder: &Path, more: &[PathBuf]) -> bool {
    let resolved = |path: &Path| match path.as_os_str().is_empty() {
        true => Path::new(".").canonicalize(),
        false => path.canonicalize(),
    };
    let Some(place) = path.ancestors().find_map(|part| resolved(part).ok()) else {
        return false;
    };
    let mut allowed = more.iter().map(PathBuf::as_path).chain([folder]);
    allowed.any(|folder| resolved(folder).is_ok_and(|folder| place.starts_with(folder)))
}

/// Imports a text; `files` reads the files it includes.
///
/// # Errors
/// If the text has problems.
pub fn import(
    name: &str,
    text: &str,
    files: Files,
    loops: Option<&Description>,
    settings: &ImportSettings,
) -> Result<Imported, WrongFile> {
    let wrong = |problems: Vec<ImportProblem>| WrongFile {
        files: vec![(name.to_owned(), text.to_owned())],
        problems: problems.into_iter().map(|problem| (0, problem)).collect(),
    };
    let whole = |kind: ImportProblemKind| wrong(vec![kind.anywhere()]);
    let text = &strict(text.to_owned());
    let files = &|file: &str| files(file).map(strict);
    let page = document(text).map_err(|problem| wrong(vec![problem]))?;
    let (mut tree, mut remarks) = match page.root_element().tag_name().name() {
        "robot" => urdf::read(text).map_err(wrong)?,
        "mujoco" => {
            let spliced = mjcf::with_copies(mjcf::splice(name, text, files)?)?;
            mjcf::read(&spliced.text).map_err(|problems| spliced.wrong(problems))?
        }
        "sdf" => sdf::read(&page, files).map_err(wrong)?,
        found => {
            return Err(whole(ImportProblemKind::NotThisFormat {
                found: found.to_owned(),
                expected: &["robot", "mujoco", "sdf"],
            }));
        }
    };
    let kept = kept_frames(&tree, loops, settings).map_err(whole)?;
    remarks.extend(on_one_pin(&mut tree));
    let (tree, rods) = without_rods(&tree, &kept);
    remarks.extend(rods);
    let source = Path::new(name)
        .file_name()
        .map_or(name.to_owned(), |name| name.to_string_lossy().into_owned());
    let source = format!("imported from {source}");
    let Unrolled {
        mut description,
        remarks: more,
        references,
        outside,
    } = describe(&tree, settings.convention, &kept, source).map_err(whole)?;
    remarks.extend(more);
    if let Some(loops) = loops {
        let references = references.into_iter().rev();
        let references = references.map(|(name, reference)| (fit(&name), reference));
        add(&mut description, loops, &references.collect());
    }
    let links = tree.bodies.iter().flat_map(|body| &body.frames);
    Ok(Imported {
        description,
        remarks,
        links: links.map(|(name, _)| fit(name)).collect(),
        outside,
    })
}

/// The frames of the tree that keep their names.
fn kept_frames(
    tree: &Tree,
    loops: Option<&Description>,
    settings: &ImportSettings,
) -> Result<Vec<String>, ImportProblemKind> {
    let frames = tree.bodies.iter().flat_map(|body| &body.frames);
    let known: Vec<&String> = frames.map(|(name, _)| name).collect();
    if settings.all_frames {
        return Ok(known.into_iter().cloned().collect());
    }
    let mut kept = Vec::new();
    for name in &settings.frames {
        if !known.contains(&name) {
            let suggestion = nearest(name, known.iter().map(|name| name.as_str()));
            return Err(ImportProblemKind::Unknown {
                noun: "link or site",
                name: name.clone(),
                suggestion: suggestion.map(str::to_owned),
            });
        }
        kept.push(name.clone());
    }
    if let Some(loops) = loops {
        let stands = loops.chains.iter().filter_map(|c| c.value.on.as_ref());
        let joined = loops.closures.iter().flat_map(|c| &c.value.frames);
        for name in stands.chain(joined) {
            let meant = known.iter().filter(|known| fit(known) == name.value);
            kept.extend(meant.map(|name| (*name).clone()));
        }
    }
    Ok(kept)
}

/// Adds the contents of a file of loops; its names of links become names of frames.
fn add(description: &mut Description, loops: &Description, references: &HashMap<String, String>) {
    let frame = |name: &mut String| {
        if let Some(reference) = references.get(name) {
            name.clone_from(reference);
        }
    };
    for joint in &loops.joints {
        let mut own = description.joints.iter_mut();
        match own.find(|own| own.name == joint.name) {
            Some(own) => {
                let limits = own.value.limits.take();
                *own = joint.clone();
                own.value.limits = own.value.limits.take().or(limits);
            }
            None => description.joints.push(joint.clone()),
        }
    }
    let convention = loops.convention.clone();
    for chain in &loops.chains {
        let mut chain = chain.clone();
        if let Some(on) = &mut chain.value.on {
            frame(&mut on.value);
        }
        chain.value.convention = chain.value.convention.or(convention.clone());
        description.chains.push(chain);
    }
    for closure in &loops.closures {
        let mut closure = closure.clone();
        let frames = closure.value.frames.iter_mut();
        frames.for_each(|name| frame(&mut name.value));
        description.closures.push(closure);
    }
    let Description {
        parameters,
        platforms,
        closed_forms,
        ..
    } = loops.clone();
    description.parameters.extend(parameters);
    description.platforms.extend(platforms);
    description.closed_forms.extend(closed_forms);
}
