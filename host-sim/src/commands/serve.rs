//! `serve`: the page, from memory.

use std::io::{self, Write};
use std::path::Path;

use anyhow::Context;
use tiny_http::{Header, Method, Request, Response, Server};

use crate::options::Serve;
use crate::wasm;

/// How the module is built, for those who have not.
const BUILD: &str = "cargo build --release --manifest-path tests/wasm/page/Cargo.toml \
                     --config tests/wasm/.cargo/config.toml \
                     --target wasm32-unknown-unknown --target-dir target";

/// Nothing from elsewhere, and no code but the page's own.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
                      img-src 'self'; connect-src 'self'; base-uri 'none'; frame-ancestors 'none'";

/// Path, media type and content of a file.
type File<'a> = (&'a str, &'static str, &'a [u8]);

macro_rules! page {
    ($name:literal, $media:literal) => {
        (concat!("/", $name), $media, include_bytes!(concat!("../../page/", $name)))
    };
}

static PAGE: [File<'static>; 7] = [
    page!("index.html", "text/html; charset=utf-8"),
    page!("page.css", "text/css; charset=utf-8"),
    page!("page.js", "text/javascript; charset=utf-8"),
    page!("engine.js", "text/javascript; charset=utf-8"),
    page!("orbit.js", "text/javascript; charset=utf-8"),
    page!("painter.js", "text/javascript; charset=utf-8"),
    page!("words.js", "text/javascript; charset=utf-8"),
];

static ICON: File<'static> = page!("icon.svg", "image/svg+xml");

/// Serves until the process is ended.
pub(super) fn run(options: &Serve) -> anyhow::Result<()> {
    let (wasm, how) = module(&options.wasm)?;
    let address = format!("127.0.0.1:{}", options.port);
    let server = Server::http(&address)
        .map_err(|error| anyhow::anyhow!("cannot listen on {address}: {error}"))?;
    let address = server.server_addr();
    let mut out = io::stdout().lock();
    writeln!(out, "http://{address}/ shows the page; Ctrl-C ends")?;
    writeln!(out, "its module: {} bytes{how}", wasm.len())?;
    out.flush()?;
    let mut files = PAGE.to_vec();
    files.extend([ICON, ("/kibiray.wasm", "application/wasm", &wasm)]);
    for request in server.incoming_requests() {
        // Whoever went away before the answer will ask again.
        let _ = answer(request, &files);
    }
    Ok(())
}

/// The module, and what there is to say of it.
fn module(path: &Path) -> anyhow::Result<(Vec<u8>, String)> {
    let bytes = std::fs::read(path).with_context(|| {
        format!("cannot read the module {}, which this builds: {BUILD}", super::shown(path))
    })?;
    anyhow::ensure!(bytes.starts_with(b"\0asm"), "{} is no WebAssembly", super::shown(path));
    Ok(match wasm::optimized(path)? {
        Some(smaller) => (smaller, format!(", {} before {}", bytes.len(), wasm::OPTIMIZER)),
        None => (bytes, format!(", as built; {} would make it smaller", wasm::OPTIMIZER)),
    })
}

fn answer(request: Request, files: &[File<'_>]) -> io::Result<()> {
    if !matches!(request.method(), Method::Get | Method::Head) {
        return request.respond(Response::empty(405));
    }
    let path = request.url().split('?').next().unwrap_or("/");
    let path = if path == "/" { "/index.html" } else { path };
    let Some((_, media, content)) = files.iter().find(|(name, ..)| *name == path) else {
        return request.respond(Response::from_string("not here\n").with_status_code(404));
    };
    let headers = [
        ("Content-Type", *media),
        ("Content-Security-Policy", POLICY),
        ("X-Content-Type-Options", "nosniff"),
        // The next run may serve another build.
        ("Cache-Control", "no-store"),
    ];
    let mut response = Response::from_data(*content);
    for (name, value) in headers {
        if let Ok(header) = Header::from_bytes(name, value) {
            response.add_header(header);
        }
    }
    request.respond(response)
}
