//! Who may ask: the page that this server served, on this machine.

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

/// Why a request is not let in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// It found the server under another name than those of this machine for itself.
    Host,
    /// It does not know the token.
    Token,
    /// Another page sent it.
    Page,
}

impl Refusal {
    /// What is wrong and what to do, for who opens the page; the server listens at this port.
    pub fn line(self, port: u16) -> String {
        let problem = match self {
            Refusal::Host => format!(
                "the page answers to the names localhost and 127.0.0.1 alone; to open it from another machine, run there \
                 ssh -L {port}:127.0.0.1:{port} and the name of this machine, and open the address that topple explore has \
                 printed here"
            ),
            Refusal::Token => "this is not the address of the page: topple explore makes a new one each time that it starts; \
                               open the address that it has printed"
                .into(),
            Refusal::Page => "another page has sent this request; open the address that topple explore has printed".into(),
        };
        format!("not allowed: {problem}\n")
    }
}

/// True of a name that a machine has for itself, with any port or none: a tunnel's own end may have another port than the server.
fn is_this_machine(host: &str) -> bool {
    const NAMES: [&str; 3] = ["localhost", "127.0.0.1", "[::1]"];
    let is_own = |name: &&str| {
        let (own, rest) = host.split_at_checked(name.len()).unwrap_or_default();
        let has_port = rest.strip_prefix(':').is_some_and(|port| port.parse::<u16>().is_ok());
        own.eq_ignore_ascii_case(name) && (rest.is_empty() || has_port)
    };
    NAMES.iter().any(is_own)
}

/// The path below the token of a request that is let in.
///
/// A foreign page can have a browser send requests here: it does not know the token, its origin is another one, and
/// under a name of its own that leads here (DNS rebinding) the host is.
///
/// # Errors
/// Why it is not.
pub fn let_in<'a>(token: &Token, said: &Credentials<'a>) -> Result<&'a str, Refusal> {
    let host = said.host.filter(|host| is_this_machine(host)).ok_or(Refusal::Host)?;
    let is_foreign = said.origin.is_some_and(|origin| origin != format!("http://{host}"))
        || said.site.is_some_and(|site| !matches!(site, "same-origin" | "none"))
        || (said.posts && !said.marked);
    if is_foreign {
        return Err(Refusal::Page);
    }
    let below = said.path.strip_prefix('/').and_then(|path| path.split_once('/'));
    below.filter(|(given, _)| token.is(given)).map(|(_, path)| path).ok_or(Refusal::Token)
}

#[cfg(test)]
mod tests {
    use super::{Credentials, Refusal, Token, let_in};

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
        for host in
            ["localhost:4000", "LOCALHOST:9999", "127.0.0.1:9999", "[::1]:9999", "localhost"]
        {
            let origin = format!("http://{host}");
            let (origin, site) = (Some(&*origin), Some("same-origin"));
            let said = Credentials {
                path: &path,
                host: Some(host),
                origin,
                site,
                posts: true,
                marked: true,
            };
            assert_eq!(let_in(&token, &said), Ok(""), "{host}");
        }
    }

    #[test]
    fn who_is_refused_reads_why_and_what_to_do() {
        let line = Refusal::Host.line(8771);
        assert!(line.contains("ssh -L 8771:127.0.0.1:8771"), "{line}");
        for refusal in [Refusal::Host, Refusal::Token, Refusal::Page] {
            let line = refusal.line(1);
            assert!(
                line.starts_with("not allowed: ") && line.contains("open the address"),
                "{line}"
            );
        }
    }

    #[test]
    fn no_two_tokens_are_alike() {
        assert_ne!(Token::new().unwrap().text(), Token::new().unwrap().text());
    }
}
