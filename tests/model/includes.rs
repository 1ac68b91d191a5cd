//! Which files an MJCF file may include, and what is said of files that are none.
#![cfg(feature = "interchange")]

use std::fs;
use std::path::Path;

use linkwork::interchange::{ImportSettings, load};

const SECRET: &str = "root:x:0:0:secret";

fn model(folder: &Path, include: &str) -> std::path::PathBuf {
    let path = folder.join("model.xml");
    let text = format!("<mujoco><include file=\"{include}\"/></mujoco>");
    fs::write(&path, text).unwrap();
    path
}

const PART: &str = "<mujocoinclude><worldbody><body name=\"a\"><joint name=\"q\" axis=\"0 0 1\"/>\
    <geom size=\"1\"/></body></worldbody></mujocoinclude>";

#[test]
fn includes_stay_in_the_folder_of_the_model() {
    let folder = tempfile::tempdir().unwrap();
    let (models, other) = (folder.path().join("models"), folder.path().join("other"));
    fs::create_dir_all(models.join("parts")).unwrap();
    fs::create_dir(&other).unwrap();
    fs::write(models.join("parts/part.xml"), PART).unwrap();
    fs::write(other.join("part.xml"), PART).unwrap();
    fs::write(other.join("passwd"), SECRET).unwrap();
    let settings = ImportSettings::default();
    let said = |include: &str, settings: &ImportSettings| {
        load(&model(&models, include), None, settings)
            .map(|_| ())
            .map_err(|e| e.to_string())
    };
    assert_eq!(said("parts/part.xml", &settings), Ok(()));
    assert_eq!(said("parts/../parts/part.xml", &settings), Ok(()));
    let absolute = other.join("part.xml").display().to_string();
    let outside = [
        "../other/part.xml",
        "../other/passwd",
        "../other/none.xml",
        &absolute,
        "../../../../etc/passwd",
    ];
    for include in outside {
        let error = said(include, &settings).unwrap_err();
        assert!(
            error.contains("outside the folder of the model"),
            "{include}: {error}"
        );
        assert!(!error.contains("root:"), "{error}");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(other.join("part.xml"), models.join("link.xml")).unwrap();
        assert!(said("link.xml", &settings).unwrap_err().contains("outside"));
    }
    let wider = ImportSettings {
        include_from: vec![other.clone()],
        ..ImportSettings::default()
    };
    assert_eq!(said("../other/part.xml", &wider), Ok(()));
    // a file that is no XML is not shown wherever it is
    let error = said("../other/passwd", &wider).unwrap_err();
    assert!(
        error.contains("not XML") && !error.contains("secret"),
        "{error}"
    );
    let missing = said("parts/none.xml", &settings).unwrap_err();
    assert!(missing.contains("cannot be included"), "{missing}");
}
