//! A headless Chromium, driven by the protocol `WebDriver`.

use crate::server::Process;
use anyhow::{Context, Result, bail, ensure};
use base64::Engine;
use serde_json::{Value, json};
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};
use ureq::Agent;

/// How long the slowest thing in the browser may take, while other tests run.
const PATIENCE: Duration = Duration::from_secs(120);

/// A page in a browser of its own.
pub(crate) struct Browser {
    session: String,
    agent: Agent,
    _driver: Process,
}

impl Browser {
    /// Starts a browser with a window of so many pixels.
    pub(crate) fn start(
        driver: &Path,
        chromium: &Path,
        (width, height): (u32, u32),
    ) -> Result<Self> {
        let (driver, port) = Process::start(Command::new(driver).arg("--port=0"), |line| {
            let port = line.split_once("successfully on port ")?.1.trim_end_matches('.');
            port.parse::<u16>().ok()
        })?;
        let agent = Agent::config_builder()
            .http_status_as_error(false)
            .timeout_global(Some(PATIENCE))
            .proxy(None)
            .build();
        let mut browser = Self {
            session: format!("http://127.0.0.1:{port}/session"),
            agent: agent.into(),
            _driver: driver,
        };
        let size = format!("--window-size={width},{height}");
        // Without a sandbox, as CI is root. The rest keeps it from calling anywhere.
        let arguments = [
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--disable-dev-shm-usage",
            "--hide-scrollbars",
            &size,
        ];
        let made = browser.post(
            "",
            &json!({"capabilities": {"alwaysMatch": {
                "browserName": "chrome",
                "goog:chromeOptions": {"binary": chromium, "args": arguments},
                "goog:loggingPrefs": {"browser": "ALL"},
            }}}),
        )?;
        let id = made["sessionId"].as_str().context("a session")?;
        browser.session = format!("{}/{id}", browser.session);
        Ok(browser)
    }

    fn post(&self, path: &str, body: &Value) -> Result<Value> {
        let url = format!("{}{path}", self.session);
        let request = self.agent.post(&url).content_type("application/json");
        let mut response = request.send(body.to_string())?;
        Self::value(path, &response.body_mut().read_to_string()?)
    }

    fn value(path: &str, answer: &str) -> Result<Value> {
        let mut answer: Value = serde_json::from_str(answer)?;
        let value = answer["value"].take();
        if let Some(error) = value["error"].as_str() {
            bail!("{path}: {error}: {}", value["message"]);
        }
        Ok(value)
    }

    pub(crate) fn open(&self, url: &str) -> Result<()> {
        self.post("/url", &json!({"url": url})).map(drop)
    }

    /// Runs JavaScript; gives what it returns.
    pub(crate) fn run(&self, script: &str) -> Result<Value> {
        self.post("/execute/sync", &json!({"script": script, "args": []}))
    }

    /// What an expression of JavaScript is, as text.
    pub(crate) fn text(&self, expression: &str) -> Result<String> {
        let value = self.run(&format!("return String({expression})"))?;
        Ok(value.as_str().context("text")?.to_owned())
    }

    /// Waits until an expression of JavaScript is true.
    pub(crate) fn wait(&self, expression: &str) -> Result<()> {
        let deadline = Instant::now() + PATIENCE;
        while self.run(&format!("return Boolean({expression})"))? != true {
            let page = "document.body.dataset.state + ': ' + document.body.innerText";
            ensure!(Instant::now() < deadline, "never: {expression}\n{}", self.text(page)?);
            thread::sleep(Duration::from_millis(50));
        }
        Ok(())
    }

    /// Presses a key: a character, or one of `WebDriver`'s code points.
    pub(crate) fn press(&self, key: char) -> Result<()> {
        let strokes = json!([{"type": "keyDown", "value": key}, {"type": "keyUp", "value": key}]);
        let keys = json!({"type": "key", "id": "keys", "actions": strokes});
        self.post("/actions", &json!({"actions": [keys]})).map(drop)
    }

    /// Drags by a mouse or a finger, from a place in the window.
    pub(crate) fn drag(&self, by: &str, from: (i32, i32), way: (i32, i32)) -> Result<()> {
        let (x, y) = from;
        let moves = json!([
            {"type": "pointerMove", "duration": 0, "x": x, "y": y},
            {"type": "pointerDown", "button": 0},
            {"type": "pointerMove", "duration": 60, "x": x + way.0 / 2, "y": y + way.1 / 2},
            {"type": "pointerMove", "duration": 60, "x": x + way.0, "y": y + way.1},
            {"type": "pointerUp", "button": 0},
        ]);
        let pointer = json!({"type": "pointer", "id": by,
            "parameters": {"pointerType": by}, "actions": moves});
        self.post("/actions", &json!({"actions": [pointer]})).map(drop)
    }

    /// Makes the window that of a phone.
    pub(crate) fn be_phone(&self, width: u32, height: u32) -> Result<()> {
        let metrics =
            json!({"width": width, "height": height, "deviceScaleFactor": 2, "mobile": true});
        let command = json!({"cmd": "Emulation.setDeviceMetricsOverride", "params": metrics});
        self.post("/goog/cdp/execute", &command).map(drop)
    }

    /// Keeps a picture of the window.
    pub(crate) fn screenshot(&self, file: &Path) -> Result<()> {
        let url = format!("{}/screenshot", self.session);
        let mut response = self.agent.get(&url).call()?;
        let value = Self::value("/screenshot", &response.body_mut().read_to_string()?)?;
        let png = value.as_str().context("a screenshot")?;
        Ok(std::fs::write(file, base64::engine::general_purpose::STANDARD.decode(png)?)?)
    }

    /// What was written to the console, by the page or about it.
    pub(crate) fn console(&self) -> Result<Vec<Value>> {
        let log = self.post("/se/log", &json!({"type": "browser"}))?;
        Ok(log.as_array().context("a log")?.clone())
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // Ends the browser; the driver ends by itself afterwards.
        let _ = self.agent.delete(&self.session).call();
    }
}
