//! A page for this machine alone, which shows its file anew when it is saved.

use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::thread;
use std::time::{Duration, Instant};

use linkwork::view::{Viewed, page};

use super::source::Source;
use super::{Answer, Refusal, write};

/// A request is a line and some headers; who sends more, or takes longer, is not answered.
const MOST_BYTES: usize = 1 << 14;
const PATIENCE: Duration = Duration::from_secs(5);

/// Serves until the program is ended.
pub fn serve(source: &Source) -> Result<Answer, Refusal> {
    let refused = |error: io::Error| Refusal::error(format!("the page cannot be served: {error}"));
    // says so at once if the file cannot be read; one with problems is shown with them
    source.viewed()?;
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).map_err(refused)?;
    let port = listener.local_addr().map_err(refused)?.port();
    let hosts = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{port}"));
    let said = format!(
        "http://{}/ shows the file and follows it until Ctrl-C.\n",
        hosts[0]
    );
    write(&said).map_err(refused)?;
    thread::scope(|scope| {
        for stream in listener.incoming() {
            // who is connected and silent keeps nobody else waiting, and a reader who goes away is no reason to end
            let answered = stream.and_then(|stream| {
                let answer = || answer(stream, &hosts, source);
                thread::Builder::new().spawn_scoped(scope, answer)
            });
            if answered.is_err() {
                // too many at a time: some have gone soon
                thread::sleep(Duration::from_millis(20));
            }
        }
    });
    unreachable!("a listener never runs out of readers")
}

fn answer(mut stream: TcpStream, hosts: &[String], source: &Source) -> io::Result<()> {
    let until = Instant::now() + PATIENCE;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut request = Vec::new();
    let mut part = [0; 1024];
    let end = loop {
        let end = request.windows(4).position(|end| end == b"\r\n\r\n");
        if let Some(end) = end {
            break end;
        }
        let left = until.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Ok(());
        }
        stream.set_read_timeout(Some(left))?;
        let bytes = stream.read(&mut part)?;
        if bytes == 0 || request.len() + bytes > MOST_BYTES {
            return Ok(());
        }
        request.extend_from_slice(&part[..bytes]);
    };
    let path = std::str::from_utf8(&request[..end]).ok();
    let path = path.and_then(|request| wanted(request, hosts));
    let viewed = path.and_then(|path| Some((path, source.viewed().ok()?)));
    let viewed = viewed.map(|(path, viewed)| {
        let watch = true;
        (path, Viewed { watch, ..viewed })
    });
    let nothing = "There is nothing here.\n";
    let (status, kind, content) = match viewed {
        Some(("/", viewed)) => ("200 OK", "text/html", page(&viewed)),
        Some(("/file", viewed)) => ("200 OK", "application/json", viewed.json()),
        _ => ("404 Not Found", "text/plain", nothing.into()),
    };
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}; charset=utf-8\r\nContent-Length: {}\r\n\
         Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n",
        content.len()
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(content.as_bytes())
}

/// The path that a request wants of this host, one of these names: a page from elsewhere whose name was made to lead here
/// has another, in its header or in its address. What is not plainly a request, as of two hosts, wants nothing
/// (RFC 9112, 3.2 and 5.1).
fn wanted<'r>(request: &'r str, hosts: &[String]) -> Option<&'r str> {
    let own = |host: &str| hosts.iter().any(|own| own.eq_ignore_ascii_case(host));
    let mut lines = request.split("\r\n");
    let mut words = lines.next()?.strip_prefix("GET ")?.split(' ');
    let (target, version) = (words.next()?, words.next()?);
    if words.next().is_some() || !version.starts_with("HTTP/1.") {
        return None;
    }
    let mut named = 0;
    for line in lines {
        let (name, value) = line.split_once(':')?;
        if name.is_empty() || name.contains(|c: char| c.is_whitespace() || c.is_control()) {
            return None;
        }
        if name.eq_ignore_ascii_case("host") {
            named += 1;
            if !own(value.trim_matches([' ', '\t'])) {
                return None;
            }
        }
    }
    let path = match target.split_at_checked(7) {
        Some((scheme, rest)) if scheme.eq_ignore_ascii_case("http://") => {
            let (host, path) = rest.split_at(rest.find('/').unwrap_or(rest.len()));
            own(host).then_some(if path.is_empty() { "/" } else { path })?
        }
        _ => target,
    };
    (named == 1).then_some(path)
}
