// SPDX-License-Identifier: Apache-2.0

//! Tokens of Rust and of C, as far as declarations go: words and numbers, strings, single marks.

/// The tokens of a text without comments; marks are of one character.
pub fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |at| at + 2)
        } else if first == '"' {
            rest[1..].find('"').map_or(rest.len(), |at| at + 2)
        } else if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (token, tail) = rest.split_at(length);
        if !first.is_whitespace() && !token.starts_with("//") && !token.starts_with("/*") {
            tokens.push(token.to_string());
        }
        rest = tail;
    }
    tokens
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// A place in a list of tokens.
pub struct Cursor<'a> {
    tokens: &'a [String],
}

impl<'a> Cursor<'a> {
    pub fn new(tokens: &'a [String]) -> Self {
        Cursor { tokens }
    }

    pub fn is_at_end(&self) -> bool {
        self.tokens.is_empty()
    }

    /// The next token but `ahead`; empty behind the end.
    pub fn peek(&self, ahead: usize) -> &'a str {
        self.tokens.get(ahead).map_or("", |token| token)
    }

    pub fn advance(&mut self) -> &'a str {
        let token = self.peek(0);
        self.tokens = self.tokens.get(1..).unwrap_or(&[]);
        token
    }

    /// Takes the given tokens if they come next.
    pub fn take(&mut self, expected: &[&str]) -> bool {
        let is_next = expected.iter().enumerate().all(|(i, token)| self.peek(i) == *token);
        if is_next {
            self.tokens = &self.tokens[expected.len()..];
        }
        is_next
    }

    pub fn expect(&mut self, expected: &[&str]) -> Result<(), String> {
        if self.take(expected) {
            return Ok(());
        }
        let found: Vec<_> = self.tokens.iter().take(12).map(String::as_str).collect();
        Err(format!("expected {:?}, found {:?}", expected.join(" "), found.join(" ")))
    }

    /// Takes all up to a mark that is outside of brackets, and the mark.
    pub fn until(&mut self, mark: &str) -> Result<&'a [String], String> {
        let mut depth = 0usize;
        for (i, token) in self.tokens.iter().enumerate() {
            if depth == 0 && token == mark {
                let (taken, rest) = self.tokens.split_at(i);
                self.tokens = &rest[1..];
                return Ok(taken);
            }
            match token.as_str() {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth = depth.checked_sub(1).ok_or_else(|| format!("{:?} is not closed", mark))?,
                _ => {}
            }
        }
        Err(format!("{:?} is missing", mark))
    }
}
