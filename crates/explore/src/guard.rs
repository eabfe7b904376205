//! Who may ask: the page that this server served, on this machine.

use std::net::SocketAddr;

/// Letters of a token.
const LETTERS: usize = 32;

/// A word that cannot be guessed, in the address of the page.
#[derive(Debug, Clone)]
pub struct Token(String);

/// The system gives no random numbers.
#[derive(Debug, Clone, Copy, thiserror::Error)]
#[error("the system gives no random numbers, which the page's address needs")]
pub struct NoToken;

impl Token {
    /// A new one, of the system's random numbers.
    ///
    /// # Errors
    /// [`NoToken`].
    pub fn new() -> Result<Token, NoToken> {
        let mut bytes = [0_u8; LETTERS / 2];
        getrandom::fill(&mut bytes).map_err(|_| NoToken)?;
        Ok(Token(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
    }

    /// As it stands in an address.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// True of the same one. It takes as long whatever is wrong.
    fn is(&self, given: &str) -> bool {
        let differ = |(own, given): (u8, u8)| own ^ given;
        let sum = self.0.bytes().zip(given.bytes()).map(differ).fold(0, |sum, one| sum | one);
        given.len() == self.0.len() && sum == 0
    }
}

/// What a request says of where it comes from.
#[derive(Debug, Clone, Copy)]
pub struct Credentials<'a> {
    /// The path of its address.
    pub path: &'a str,
    /// `Host`: the name under which it found the server.
    pub host: Option<&'a str>,
    /// `Origin`: the page that it comes from, where a browser says it.
    pub origin: Option<&'a str>,
    /// `Sec-Fetch-Site`: same-origin, none, or from elsewhere.
    pub site: Option<&'a str>,
    /// It changes or computes something.
    pub posts: bool,
    /// It has the header that no foreign page can give without being asked first.
    pub marked: bool,
}

/// The path below the token of a request that is let in; none of one that is not.
///
/// A foreign page can have a browser send requests here: it does not know the token, its origin is another one, and
/// under a name of its own that leads here (DNS rebinding) the host is.
pub fn let_in<'a>(token: &Token, at: SocketAddr, said: &Credentials<'a>) -> Option<&'a str> {
    let port = at.port();
    let hosts = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    let host = said.host.filter(|host| hosts.iter().any(|own| own.eq_ignore_ascii_case(host)))?;
    if said.origin.is_some_and(|origin| origin != format!("http://{host}")) {
        return None;
    }
    if said.site.is_some_and(|site| !matches!(site, "same-origin" | "none")) {
        return None;
    }
    if said.posts && !said.marked {
        return None;
    }
    let (given, path) = said.path.strip_prefix('/')?.split_once('/')?;
    token.is(given).then_some(path)
}

#[cfg(test)]
mod tests {
    use super::{Credentials, Token, let_in};

    #[test]
    fn only_the_own_page_is_let_in() {
        let token = Token::new().unwrap();
        let at = "127.0.0.1:4000".parse().unwrap();
        let path = format!("/{}/map", token.text());
        let own = Credentials {
            path: &path,
            host: Some("127.0.0.1:4000"),
            origin: Some("http://127.0.0.1:4000"),
            site: Some("same-origin"),
            posts: true,
            marked: true,
        };
        assert_eq!(let_in(&token, at, &own), Some("map"));
        let local = Credentials { host: Some("localhost:4000"), origin: None, site: None, ..own };
        assert_eq!(let_in(&token, at, &local), Some("map"));
        let short = &path[..path.len() - 6];
        for foreign in [
            Credentials { host: None, ..own },
            Credentials { host: Some("evil.example:4000"), ..own },
            Credentials { host: Some("127.0.0.1:4001"), ..own },
            Credentials { origin: Some("http://evil.example"), ..own },
            Credentials { origin: Some("null"), ..own },
            Credentials { origin: Some("http://localhost:4000"), ..own },
            Credentials { site: Some("cross-site"), ..own },
            Credentials { site: Some("same-site"), ..own },
            Credentials { marked: false, ..own },
            Credentials { path: "/map", ..own },
            Credentials { path: "/0123456789abcdef0123456789abcdef/map", ..own },
            Credentials { path: short, ..own },
            Credentials { path: "//map", ..own },
        ] {
            assert_eq!(let_in(&token, at, &foreign), None, "{foreign:?}");
        }
    }

    #[test]
    fn no_two_tokens_are_alike() {
        assert_ne!(Token::new().unwrap().text(), Token::new().unwrap().text());
    }
}
