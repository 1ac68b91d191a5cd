//! Structures of a file, each declared once: its fields with their types, their names in the file and what is expected there.
//!
//! From these tables follow the structures themselves, how they are read and how they are written: each is given a macro that
//! makes one of these.
//!
//! | form | in the file |
//! |---|---|
//! | `file` | named, with the version first |
//! | `named` | named |
//! | `part` | fields in parentheses |
//! | `by kind` | named by the word of its field `kind` |
//!
//! A field is `"name" as` what is expected; `within`, if its fields stand among the others; `place`, that of the structure, which
//! is no content; or `apart`, which the file does not have.

/// Structures and their equality: parts are equal if their contents are, wherever they are in their files.
macro_rules! declared {
    ($($(#[$about:meta])* $name:ident = $form:ident $($by:ident)? $word:literal, $said:literal {
        $($(#[$doc:meta])* $field:ident: $type:ty = $key:tt $(as $expected:expr)?,)+
    })+) => {$(
        $(#[$about])*
        #[derive(Debug, Clone)]
        pub struct $name {
            $($(#[$doc])* pub $field: $type,)+
        }

        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                $(declared!(same self, other, $field $key))&&+
            }
        }
    )+};
    (same $one:ident, $other:ident, $field:ident place) => {
        true
    };
    (same $one:ident, $other:ident, $field:ident $key:tt) => {
        $one.$field == $other.$field
    };
}

macro_rules! part_structures {
    ($made:ident) => {
        $made! {
            /// A whole mechanism file. Everything is in the order of the file.
            #[derive(Default)]
            Description = file "Mechanism", "a mechanism" {
                /// The name of the mechanism.
                name: Spanned<String> = "name" as Expected::TEXT,
                /// Its source in the literature.
                source: Option<Spanned<String>> = "source" as Expected::TEXT,
                /// The convention of the chains that give none.
                convention: Option<Spanned<Convention>> = "convention" as Expected::CONVENTION,
                /// The most by which any number of the file is off (m), if not half a unit of its last digit.
                tolerance: Option<Entry> = "tolerance" as Expected::ENTRY,
                /// Dimensions and other constants.
                parameters: Vec<Named<Entry>> = "parameters" as Expected::MapOf(Noun::Parameter),
                /// The joint variables.
                joints: Vec<Named<JointDescription>> = "joints" as Expected::MapOf(Noun::Joint),
                /// The serial chains left when the mechanism is broken at some joints.
                chains: Vec<Named<ChainDescription>> = "chains" as Expected::MapOf(Noun::Chain),
                /// Rigid bodies whose pose is unknown.
                platforms: Vec<Named<PlatformDescription>> = "platforms" as Expected::MapOf(Noun::Platform),
                /// The closures that restore the broken joints.
                closures: Vec<Named<ClosureDescription>> = "closures" as Expected::MapOf(Noun::Closure),
                /// Formulas to be checked against the chains.
                closed_forms: Vec<Named<ClosedFormDescription>> = "closed_forms" as Expected::MapOf(Noun::ClosedForm),
                /// Quantities of interest, over joints, coordinates of points, rates and forces.
                outputs: Vec<Named<Entry>> = "outputs" as Expected::MapOf(Noun::Output),
                /// Masses, springs and forces.
                loads: LoadsDescription = within,
                /// The joint coordinates from which all this was made, if it was.
                coordinates: Option<Box<super::JointCoordinates>> = apart,
            }

            /// A joint variable.
            JointDescription = by role "Joint", "a joint" {
                /// Actuated or passive.
                role: Role = apart,
                /// Its value in the home configuration; 0 if not given.
                home: Entry = "home" as Expected::ENTRY,
                /// Lowest and highest value.
                limits: Option<(Entry, Entry)> = "limits" as Expected::LIMITS,
                /// Place of its declaration.
                span: Range<usize> = place,
            }

            /// A serial chain.
            #[derive(Default)]
            ChainDescription = named "Chain", "a chain" {
                /// The frame to which it is attached; ground if not given.
                on: Option<Spanned<String>> = "on" as Expected::FRAME,
                /// The convention of its rows, if it is not that of the file.
                convention: Option<Spanned<Convention>> = "convention" as Expected::CONVENTION,
                /// Displacement from that frame to the frame before the first row.
                base: Vec<Displacement> = "base" as Expected::TRANSFORM,
                /// The Denavit–Hartenberg table.
                rows: Vec<RowDescription> = "rows" as Expected::ROWS,
                /// Displacement from the frame after the last row to the tip.
                tip: Vec<Displacement> = "tip" as Expected::TRANSFORM,
            }

            /// A row of a Denavit–Hartenberg table. Absent entries are 0.
            RowDescription = part "Row", "a row" {
                /// Twist of the link (rad).
                alpha: Entry = "alpha" as Expected::ENTRY,
                /// Length of the link (m).
                a: Entry = "a" as Expected::ENTRY,
                /// Offset along the joint axis (m).
                d: Entry = "d" as Expected::ENTRY,
                /// Angle about the joint axis (rad).
                theta: Entry = "theta" as Expected::ENTRY,
                /// Turn about y behind the twist (rad), where consecutive axes are nearly parallel (Hayati).
                beta: Entry = "beta" as Expected::ENTRY,
                /// A name for the link behind the row, which is its body.
                link: Option<Spanned<String>> = "link" as Expected::NameOf(Noun::Body),
                /// The place of the row.
                span: Range<usize> = place,
            }

            /// A rigid body whose pose is unknown.
            #[derive(Default)]
            PlatformDescription = named "Platform", "a platform" {
                /// Its pose in the home configuration.
                home: Vec<Displacement> = "home" as Expected::TRANSFORM,
                /// Frames fixed in it.
                frames: Vec<Named<Vec<Displacement>>> = "frames" as Expected::MapOf(Noun::PlatformFrame),
            }

            /// A printed formula, either for the pose of a frame or an identity.
            ClosedFormDescription = named "ClosedForm", "a closed form" {
                /// The frame whose pose is given; absent only if the form consists of identities.
                of: Option<Spanned<String>> = "of" as Expected::FRAME,
                /// `in`: the frame in which it is expressed; ground if not given.
                relative_to: Option<Spanned<String>> = "in" as Expected::FRAME,
                /// `where`: local names.
                locals: Vec<Named<Entry>> = "where" as Expected::MapOf(Noun::LocalName),
                /// Publication in which it is printed.
                source: Option<Spanned<String>> = "source" as Expected::TEXT,
                /// The position (m).
                position: Option<[Entry; 3]> = "position" as Expected::VECTOR,
                /// The rotation matrix, row by row.
                rotation: Option<[[Entry; 3]; 3]> = "rotation" as Expected::ROTATION,
                /// Rotation and position `[R | p]`, row by row.
                transform: Option<[[Entry; 4]; 3]> = "transform" as Expected::HOMOGENEOUS,
                /// Single entries of `[R | p]`.
                entries: Vec<(Spanned<MatrixEntry>, Entry)> = "entries" as Expected::MapOf(Noun::MatrixEntry),
                /// An expression that vanishes at every assembled configuration.
                identity: Option<Entry> = "identity" as Expected::ENTRY,
                /// Several of them.
                identities: Vec<Named<Entry>> = "identities" as Expected::MapOf(Noun::Identity),
            }
        }
    };
}

macro_rules! load_structures {
    ($made:ident) => {
        $made! {
            /// Loads of a mechanism: weight and inertia of bodies, springs, forces, friction.
            #[derive(Default)]
            LoadsDescription = part "Loads", "loads" {
                /// The acceleration of free fall (m/s²), in ground.
                gravity: Option<[Entry; 3]> = "gravity" as Expected::VECTOR,
                /// Masses under the names of bodies, or of frames and points on them.
                masses: Vec<Named<MassDescription>> = "masses" as Expected::MapOf(Noun::Mass),
                /// Springs, forces and friction.
                loads: Vec<Named<LoadDescription>> = "loads" as Expected::MapOf(Noun::Load),
            }

            /// The mass of a body, or of a part of one.
            MassDescription = part "Mass", "a mass" {
                /// The mass (kg), unless it follows from shape and density.
                mass: Option<Entry> = "mass" as Expected::ENTRY,
                /// The centre of mass in the frame (m).
                centre: Option<[Entry; 3]> = "centre" as Expected::VECTOR,
                /// Ixx, Iyy, Izz, Ixy, Ixz, Iyz about the centre of mass along the axes of the frame (kg·m²), or Izz of a flat body
                /// alone.
                inertia: Option<InertiaDescription> = "inertia" as Expected::INERTIA,
                /// A homogeneous shape about the centre of mass.
                shape: Option<ShapeDescription> = "shape" as Expected::SHAPE,
                /// Its density: kg/m for a rod, kg/m² for a plate, else kg/m³.
                density: Option<Entry> = "density" as Expected::ENTRY,
                /// The turn of the axes of inertia or shape against those of the frame.
                turned: Vec<Displacement> = "turned" as Expected::TRANSFORM,
                /// Its place.
                span: Range<usize> = place,
            }
        }
    };
}

macro_rules! axes_structures {
    ($made:ident) => {
        $made! {
            /// A whole file of joint axes. Everything is in the order of the file.
            #[derive(Default)]
            AxesDescription = file "Axes", "a file of joint coordinates" {
                /// The name of the mechanism.
                name: Spanned<String> = "name" as Expected::TEXT,
                /// Its source in the literature.
                source: Option<Spanned<String>> = "source" as Expected::TEXT,
                /// The convention of the tables to be made.
                convention: Option<Spanned<Convention>> = "convention" as Expected::CONVENTION,
                /// The most by which any number of the file is off (m), if not half a unit of its last digit.
                tolerance: Option<Entry> = "tolerance" as Expected::ENTRY,
                /// Dimensions and other constants.
                parameters: Vec<Named<Entry>> = "parameters" as Expected::MapOf(Noun::Parameter),
                /// The joints; in a serial chain from the base to the tool.
                joints: Vec<Named<AxisDescription>> = "joints" as Expected::MapOf(Noun::Axis),
                /// Frames of bodies in the drawing; a body without one has its frame at the joint that carries it.
                bodies: Vec<Named<AxisPlace>> = "bodies" as Expected::MapOf(Noun::Body),
                /// Points on bodies, and frames.
                points: Vec<Named<PointDescription>> = "points" as Expected::MapOf(Noun::Point),
                /// The frame from which the tables should start.
                base: Option<Vec<Displacement>> = "base" as Expected::TRANSFORM,
                /// The frame at which a serial chain ends.
                tool: Option<Vec<Displacement>> = "tool" as Expected::TRANSFORM,
                /// Expressions of joints that are zero, as of cams and gears of varying ratio.
                couplings: Vec<Named<Entry>> = "couplings" as Expected::MapOf(Noun::Coupling),
                /// The joints at which closed loops are to be cut.
                cut: Vec<Spanned<String>> = "cut" as Expected::CUTS,
                /// Formulas to be checked.
                closed_forms: Vec<Named<ClosedFormDescription>> = "closed_forms" as Expected::MapOf(Noun::ClosedForm),
                /// Quantities of interest, over joints, coordinates of points, rates and forces.
                outputs: Vec<Named<Entry>> = "outputs" as Expected::MapOf(Noun::Output),
                /// Masses, springs and forces.
                loads: LoadsDescription = within,
            }
        }
    };
}

pub(super) use {axes_structures, declared, load_structures, part_structures};
