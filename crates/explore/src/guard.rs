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
