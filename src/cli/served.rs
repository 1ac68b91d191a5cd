//! A page for this machine alone, which shows its file anew when it is saved.

use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::time::Duration;

use linkwork::output::view::{Viewed, page};

use super::source::Source;
use super::{Answer, Refusal, write};

/// A request is a line and some headers; who sends more, or nothing for so long, is not answered.
const MOST_BYTES: usize = 1 << 14;
const PATIENCE: Duration = Duration::from_secs(5);

/// Serves until the program is ended.
pub fn serve(source: &Source) -> Result<Answer, Refusal> {
    let refused = |error: io::Error| Refusal::error(format!("the page cannot be served: {error}"));
    // says so at once if the file cannot be read; one with problems is shown with them
    source.viewed()?;
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).map_err(refused)?;
    let host = listener.local_addr().map_err(refused)?.to_string();
    let said = format!("http://{host}/ shows the file and follows it until Ctrl-C.\n");
    write(&said).map_err(refused)?;
    for stream in listener.incoming().flatten() {
        // a reader who goes away is no reason to end
        let _ = answer(stream, &host, source);
    }
    unreachable!("a listener never runs out of readers")
}

fn answer(mut stream: TcpStream, host: &str, source: &Source) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut request = Vec::new();
    let mut part = [0; 1024];
    while !request.windows(4).any(|end| end == b"\r\n\r\n") {
        let bytes = stream.read(&mut part)?;
        if bytes == 0 || request.len() + bytes > MOST_BYTES {
            return Ok(());
        }
        request.extend_from_slice(&part[..bytes]);
    }
    let request = String::from_utf8_lossy(&request);
    let mut lines = request.lines();
    let path = lines.next();
    let path = path.and_then(|line| line.strip_prefix("GET ")?.split(' ').next());
    // a page from elsewhere whose name was made to lead here has another host
    let mut headers = lines.filter_map(|line| line.split_once(':'));
    let own =
        headers.any(|(name, value)| name.eq_ignore_ascii_case("host") && value.trim() == host);
    let viewed = source.viewed().map(|viewed| Viewed {
        watch: true,
        ..viewed
    });
    let nothing = "There is nothing here.\n";
    let (status, kind, content) = match (path, viewed) {
        (Some("/"), Ok(viewed)) if own => ("200 OK", "text/html", page(&viewed)),
        (Some("/file"), Ok(viewed)) if own => ("200 OK", "application/json", viewed.json()),
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
