//! Files of other programs.

use topple_records::other_programs::{of, of_zip};

#[test]
fn files_of_other_programs_are_told_with_what_to_do() {
    let mut tape = vec![0; 512];
    tape[257..262].copy_from_slice(b"ustar");
    let mut seed = b"000001D XXX  HNE".to_vec();
    seed.resize(512, 0);
    for (bytes, said) in [
        (&tape[..], "a tar archive"),
        (&seed, "obspy.read"),
        (b"MS\x03\0", "obspy.read"),
        (b"MATLAB 5.0 MAT-file, Platform: GLNXA64", "scipy.io.loadmat"),
        (b"MATLAB 7.3 MAT-file", "h5py"),
        (b"\x89HDF\r\n\x1a\n", "HDF5"),
        (b"\x93NUMPY\x01", "numpy.load"),
        (b"BZh91AY", "bzip2"),
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:00", "a pointer of Git LFS"),
    ] {
        let what = of(bytes).unwrap();
        assert!(what.contains(said) && what.contains("; "), "{what}");
    }
    for bytes in [&b""[..], b"1\n2\n", b"MATLAB script", b"000001D", b"PEER NGA"] {
        assert_eq!(of(bytes), None);
    }
    let names =
        |names: &[&str]| of_zip(&names.iter().map(|name| name.to_string()).collect::<Vec<_>>());
    assert!(names(&["xl/workbook.xml", "a"]).unwrap().contains("CSV"));
    assert!(names(&["a.npy", "b.npy"]).unwrap().contains("numpy.load"));
    assert!(names(&["mimetype", "content.xml", "META-INF/manifest.xml"]).unwrap().contains("CSV"));
    assert_eq!(names(&["a.at2", "b.npy"]), None);
    assert_eq!(names(&[]), None);
}
