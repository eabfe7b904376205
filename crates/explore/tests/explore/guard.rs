use topple_explore::guard::{Credentials, Refusal, Token, let_in};

#[test]
fn only_the_own_page_is_let_in() {
    let token = Token::new().unwrap();
    let path = format!("/{}/map", token.text());
    let own = Credentials {
        path: &path,
        host: Some("127.0.0.1:4000"),
        origin: Some("http://127.0.0.1:4000"),
        site: Some("same-origin"),
        posts: true,
        marked: true,
    };
    assert_eq!(let_in(&token, &own), Ok("map"));
    let short = &path[..path.len() - 6];
    let of = |host| Credentials { host: Some(host), origin: None, ..own };
    for (foreign, why) in [
        (Credentials { host: None, ..own }, Refusal::Host),
        (of("evil.example:4000"), Refusal::Host),
        (of("localhost.evil.example:4000"), Refusal::Host),
        (of("evil-localhost:4000"), Refusal::Host),
        (of("localhost:4000.evil.example"), Refusal::Host),
        (of("localhost:"), Refusal::Host),
        (of("localhost:70000"), Refusal::Host),
        (of("127.0.0.1.evil.example"), Refusal::Host),
        (of("127.0.0.2:4000"), Refusal::Host),
        (of("[::2]:4000"), Refusal::Host),
        (of("é"), Refusal::Host),
        // The port is free, but it is that of the page that asks.
        (Credentials { host: Some("127.0.0.1:4001"), ..own }, Refusal::Page),
        (Credentials { origin: Some("http://evil.example"), ..own }, Refusal::Page),
        (Credentials { origin: Some("null"), ..own }, Refusal::Page),
        (Credentials { origin: Some("http://localhost:4000"), ..own }, Refusal::Page),
        (Credentials { site: Some("cross-site"), ..own }, Refusal::Page),
        (Credentials { site: Some("same-site"), ..own }, Refusal::Page),
        (Credentials { marked: false, ..own }, Refusal::Page),
        (Credentials { path: "/map", ..own }, Refusal::Token),
        (Credentials { path: "/0123456789abcdef0123456789abcdef/map", ..own }, Refusal::Token),
        (Credentials { path: short, ..own }, Refusal::Token),
        (Credentials { path: "//map", ..own }, Refusal::Token),
    ] {
        assert_eq!(let_in(&token, &foreign), Err(why), "{foreign:?}");
    }
}

#[test]
fn a_tunnel_may_have_another_port() {
    let token = Token::new().unwrap();
    let path = format!("/{}/", token.text());
    for host in ["localhost:4000", "LOCALHOST:9999", "127.0.0.1:9999", "[::1]:9999", "localhost"] {
        let origin = format!("http://{host}");
        let (origin, site) = (Some(&*origin), Some("same-origin"));
        let said =
            Credentials { path: &path, host: Some(host), origin, site, posts: true, marked: true };
        assert_eq!(let_in(&token, &said), Ok(""), "{host}");
    }
}

#[test]
fn who_is_refused_reads_why_and_what_to_do() {
    let line = Refusal::Host.line(8771);
    assert!(line.contains("ssh -L 8771:127.0.0.1:8771"), "{line}");
    for refusal in [Refusal::Host, Refusal::Token, Refusal::Page] {
        let line = refusal.line(1);
        assert!(line.starts_with("not allowed: ") && line.contains("open the address"), "{line}");
    }
}

#[test]
fn no_two_tokens_are_alike() {
    assert_ne!(Token::new().unwrap().text(), Token::new().unwrap().text());
}
