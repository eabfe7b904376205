use topple_explore::refused::Refused;

#[test]
fn a_message_is_one_short_line() {
    let told = Refused::of("t_h", format!("{} must be `1`\r\nor {}", 1.0e-300, "x".repeat(999)));
    assert!(told.line.starts_with("t_h: 1e-300 must be 1  or xx"), "{told}");
    assert!(told.line.ends_with('…') && told.line.len() < 300, "{told}");
    assert_eq!(Refused::told("/a/long/path is 12345.678 m").line, "/a/long/path is 12345.678 m");
}
