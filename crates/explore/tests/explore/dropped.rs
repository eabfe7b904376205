use topple_explore::dropped::parts;

#[test]
fn files_are_those_of_the_header_and_of_a_whole_body_alone() {
    let body = |header: &str, bytes: &str| {
        let length = (header.len() as u32).to_le_bytes();
        [&length[..], header.as_bytes(), bytes.as_bytes()].concat()
    };
    let header = r#"[["a \"b\".txt",2],["empty",0],["c",3]]"#;
    let files = parts(body(header, "12345").into()).unwrap();
    let names: Vec<&str> = files.iter().map(|(name, _)| &**name).collect();
    assert_eq!(names, ["a \"b\".txt", "empty", "c"]);
    assert_eq!(
        files.iter().map(|(_, bytes)| &bytes[..]).collect::<Vec<_>>(),
        [&b"12"[..], b"", b"345"]
    );
    assert!(parts(body("[]", "").into()).unwrap().is_empty());
    let far = format!(r#"[["a",{}]]"#, u64::MAX);
    for wrong in [
        body(header, "1234"),
        body(header, "123456"),
        body("{}", ""),
        body(&far, "1"),
        vec![9, 0, 0, 0],
        vec![1],
    ] {
        assert!(parts(wrong.clone().into()).is_none(), "{wrong:?}");
    }
}
