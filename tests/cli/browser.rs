//! A browser without a window, driven through its debugging pipe (the Chrome DevTools Protocol:
//! JSON messages that end in a zero byte, on file descriptors 3 and 4).

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use serde_json::{Value, json};

/// Names that Chromium and its kin are installed under.
const NAMES: [&str; 5] =
    ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome"];
/// A browser that does not answer for this long hangs.
const PATIENCE: Duration = Duration::from_secs(600);

/// A page open in a browser of its own; errors on its console and requests to the network are kept.
pub struct Browser {
    child: Child,
    pipe: ChildStdin,
    messages: Receiver<Value>,
    session: Value,
    calls: u64,
    complaints: Vec<String>,
    _profile: tempfile::TempDir,
}

impl Browser {
    /// Opens a file in a window of the given size (CSS pixels); a narrow one is a phone's, with touch.
    pub fn open(file: &Path, [width, height]: [u32; 2]) -> Self {
        let profile = tempfile::tempdir().expect("a temporary folder");
        let mut child = Command::new("sh")
            .args(["-c", "exec \"$0\" \"$@\" 3<&0 4>&1 1>&2"])
            .arg(installed())
            .args(["--headless", "--no-sandbox", "--remote-debugging-pipe", "--hide-scrollbars"])
            .args(["--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
            .args(["--no-first-run", "--disable-background-networking", "--disable-dev-shm-usage"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("sh starts");
        let pipe = child.stdin.take().expect("a pipe was asked for");
        let answers = BufReader::new(child.stdout.take().expect("a pipe was asked for"));
        let (sender, messages) = mpsc::channel();
        std::thread::spawn(move || {
            for message in answers.split(0).map_while(Result::ok) {
                let message = serde_json::from_slice(&message).expect("the browser speaks JSON");
                if sender.send(message).is_err() {
                    break;
                }
            }
        });
        let mut browser = Self {
            child,
            pipe,
            messages,
            session: Value::Null,
            calls: 0,
            complaints: Vec::new(),
            _profile: profile,
        };
        let target = browser.call("Target.createTarget", json!({ "url": "about:blank" }));
        let target = json!({ "targetId": target["targetId"], "flatten": true });
        browser.session = browser.call("Target.attachToTarget", target)["sessionId"].take();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        let is_phone = width < 500;
        browser.call(
            "Emulation.setDeviceMetricsOverride",
            json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": is_phone }),
        );
        browser.call("Emulation.setTouchEmulationEnabled", json!({ "enabled": is_phone }));
        let path = file.canonicalize().expect("the file is there");
        browser.call("Page.navigate", json!({ "url": format!("file://{}", path.display()) }));
        while browser.next_message()["method"] != "Page.loadEventFired" {}
        browser
    }

    /// Calls a method of the protocol and returns its result.
    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.calls += 1;
        let mut message = json!({ "id": self.calls, "method": method, "params": parameters });
        if !self.session.is_null() {
            message["sessionId"] = self.session.clone();
        }
        self.pipe.write_all(format!("{message}\0").as_bytes()).expect("the browser listens");
        loop {
            let mut answer = self.next_message();
            if answer["id"] == self.calls {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].take();
            }
        }
    }

    /// The value of a JavaScript expression, awaited.
    pub fn value(&mut self, expression: &str) -> Value {
        let parameters =
            json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let mut answer = self.call("Runtime.evaluate", parameters);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        answer["result"]["value"].take()
    }

    /// Waits until a JavaScript condition holds after some frame.
    pub fn wait_until(&mut self, condition: &str) {
        let frames = format!(
            "new Promise(done => {{ const look = () => ({condition}) ? done() : \
             requestAnimationFrame(look); look(); }})"
        );
        self.value(&frames);
    }

    /// Presses and lets go the mouse at a part (0 to 1, from the left) of an element's width.
    pub fn click(&mut self, selector: &str, part: f64) {
        let place = self.place(selector, part);
        self.click_at(place);
    }

    /// Presses and lets go the mouse at a place in the window.
    pub fn click_at(&mut self, [x, y]: [f64; 2]) {
        for kind in ["mousePressed", "mouseReleased"] {
            let event = json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", event);
        }
    }

    /// Moves the mouse to a place in the window.
    pub fn move_to(&mut self, [x, y]: [f64; 2]) {
        self.call("Input.dispatchMouseEvent", json!({ "type": "mouseMoved", "x": x, "y": y }));
    }

    /// Touches an element and draws the finger to the right.
    pub fn swipe(&mut self, selector: &str, distance: f64) {
        let [x, y] = self.place(selector, 0.4);
        let steps = [("touchStart", Some(0.0)), ("touchMove", Some(0.5)), ("touchMove", Some(1.0))];
        for (kind, part) in steps.into_iter().chain([("touchEnd", None)]) {
            let points = part.map(|part| json!({ "x": x + part * distance, "y": y }));
            let points: Vec<Value> = points.into_iter().collect();
            self.call("Input.dispatchTouchEvent", json!({ "type": kind, "touchPoints": points }));
        }
    }

    /// What an element looks like, as a PNG in base64.
    pub fn picture(&mut self, selector: &str) -> String {
        // Two frames: one that draws, and one to know that it has been.
        self.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))");
        let clip = self.value(&format!(
            "(({{ x, y, width, height }}) => ({{ x, y, width, height, scale: 1 }}))\
             (document.querySelector('{selector}').getBoundingClientRect())"
        ));
        let mut picture = self.call("Page.captureScreenshot", json!({ "clip": clip }));
        match picture["data"].take() {
            Value::String(data) => data,
            other => panic!("no picture: {other}"),
        }
    }

    /// Errors on the console so far, uncaught exceptions and requests that left the file.
    pub fn complaints(&mut self) -> &[String] {
        // An answer to this comes after everything that happened before.
        self.value("0");
        &self.complaints
    }

    fn place(&mut self, selector: &str, part: f64) -> [f64; 2] {
        let place = self.value(&format!(
            "(r => [r.x + {part} * r.width, r.y + 0.5 * r.height])\
             (document.querySelector('{selector}').getBoundingClientRect())"
        ));
        [0, 1].map(|i| place[i].as_f64().expect("a place on the page"))
    }

    fn next_message(&mut self) -> Value {
        let message = self.messages.recv_timeout(PATIENCE).expect("the browser answers");
        let parameters = &message["params"];
        let complaint = match message["method"].as_str().unwrap_or_default() {
            "Runtime.exceptionThrown" => Some(&parameters["exceptionDetails"]),
            "Runtime.consoleAPICalled" if parameters["type"] == "error" => {
                Some(&parameters["args"])
            }
            "Log.entryAdded" if parameters["entry"]["level"] == "error" => {
                Some(&parameters["entry"])
            }
            "Network.requestWillBeSent" => Some(&parameters["request"]["url"]).filter(|url| {
                let url = url.as_str().unwrap_or_default();
                !["file:", "data:", "blob:"].iter().any(|local| url.starts_with(local))
            }),
            _ => None,
        };
        self.complaints.extend(complaint.map(Value::to_string));
        message
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        // Gone already is as good.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The browser to drive: `RIGHTING_BROWSER`, or the first known name on the path.
fn installed() -> PathBuf {
    if let Some(named) = std::env::var_os("RIGHTING_BROWSER") {
        return named.into();
    }
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path)
        .flat_map(|folder| NAMES.map(|name| folder.join(name)))
        .find(|candidate| candidate.is_file())
        .expect(
            "this test drives a browser and finds none: run scripts/setup.sh test (or apt-get \
             install chromium), or name a Chromium in RIGHTING_BROWSER",
        )
}
