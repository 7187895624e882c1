//! The parent's end of a worker process.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use serde::Serialize;
use serde::de::DeserializeOwned;

/// No message is longer, bytes.
const LONGEST_LINE: u64 = 1 << 20;
/// How often a wait looks whether it shall go on.
const LOOK_EVERY: Duration = Duration::from_millis(50);
/// How long the last words of a dead worker are waited for.
const LAST_WORDS: Duration = Duration::from_millis(200);
const LONGEST_LAST_WORDS: usize = 300;

/// A worker process; killed when it is dropped.
pub(crate) struct Process {
    child: Child,
    stdin: ChildStdin,
    lines: Receiver<String>,
    complaints: Receiver<String>,
}

/// Why there is no answer.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Silence {
    /// The process ended: how.
    Died(String),
    /// No answer in time.
    Hung,
    /// Nobody waits any longer.
    Halted,
}

impl Process {
    pub fn start(mut command: Command) -> std::io::Result<Self> {
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn()?;
        let (Some(stdin), Some(stdout), Some(stderr)) =
            (child.stdin.take(), child.stdout.take(), child.stderr.take())
        else {
            return Err(std::io::Error::other("its pipes are missing"));
        };
        Ok(Self { stdin, lines: lines_of(stdout), complaints: lines_of(stderr), child })
    }

    /// Sends a message as one line.
    pub fn send(&mut self, message: &impl Serialize) -> Result<(), Silence> {
        let mut line = serde_json::to_vec(message).expect("a message is made of what JSON has");
        line.push(b'\n');
        self.stdin.write_all(&line).map_err(|_| self.death())
    }

    /// The next message. Lines that are none, such as a library's, are skipped.
    pub fn receive<T: DeserializeOwned>(
        &mut self,
        patience: Duration,
        halted: impl Fn() -> bool,
    ) -> Result<T, Silence> {
        let asked = Instant::now();
        loop {
            match self.lines.recv_timeout(LOOK_EVERY) {
                Ok(line) => {
                    if let Ok(message) = serde_json::from_str(&line) {
                        return Ok(message);
                    }
                }
                Err(RecvTimeoutError::Disconnected) => return Err(self.death()),
                Err(RecvTimeoutError::Timeout) if halted() => return Err(Silence::Halted),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if asked.elapsed() >= patience {
                return Err(Silence::Hung);
            }
        }
    }

    /// How the process ended; ends it if it only stopped talking.
    fn death(&mut self) -> Silence {
        // A process that closed its output is as good as dead, and may need help.
        let deadline = Instant::now() + LAST_WORDS;
        let mut words = Vec::new();
        while let Ok(line) = self.complaints.recv_timeout(deadline - Instant::now().min(deadline)) {
            if !line.starts_with("note:") {
                words.push(line);
            }
        }
        let status = match self.child.try_wait() {
            Ok(Some(status)) => Ok(status),
            _ => self.child.kill().and_then(|()| self.child.wait()),
        };
        let mut text = status.map_or_else(|error| error.to_string(), |status| status.to_string());
        if !words.is_empty() {
            text.push_str(": ");
            text.extend(words.join(" ").chars().take(LONGEST_LAST_WORDS));
        }
        Silence::Died(text)
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // It may be dead already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The lines of a stream, read by a thread that ends with it.
fn lines_of(stream: impl Read + Send + 'static) -> Receiver<String> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let mut stream = BufReader::new(stream);
        let mut bytes = Vec::new();
        let mut next =
            |bytes: &mut Vec<u8>| stream.by_ref().take(LONGEST_LINE).read_until(b'\n', bytes);
        while matches!(next(&mut bytes), Ok(1..)) {
            // A process that never ends its line may not fill the memory.
            if bytes.len() as u64 == LONGEST_LINE {
                bytes.clear();
                continue;
            }
            let line = String::from_utf8_lossy(&bytes).trim().to_owned();
            if sender.send(line).is_err() {
                break;
            }
            bytes.clear();
        }
    });
    receiver
}
