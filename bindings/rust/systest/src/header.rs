// SPDX-License-Identifier: Apache-2.0

//! What the header has, from its text as the preprocessor leaves it.

use crate::compiler;
use crate::names::Names;
use crate::token::{tokens, Cursor};
use std::path::Path;

/// Macros that are not constants.
const NO_CONSTANTS: [&str; 3] = ["BDPT_H", "BDPT_API", "BDPT_CHECK"];

pub fn names(include: &Path) -> Result<Names, String> {
    let mut names = Names::default();
    let macros = compiler::run(&["-E", "-dM"], include, "#include <bdpt.h>\n")?;
    for line in macros.lines() {
        let name = line.split(|c: char| c.is_whitespace() || c == '(').nth(1).unwrap_or("");
        if name.starts_with("BDPT_") && !NO_CONSTANTS.contains(&name) {
            names.constants.insert(name.to_string());
        }
    }
    // Without the line marks; -nostdinc would lack stdint.h, so that declarations of the system come, too.
    let text = compiler::run(&["-E", "-P"], include, "#include <bdpt.h>\n")?;
    let tokens = tokens(&text);
    let mut at = Cursor::new(&tokens);
    while !at.is_at_end() {
        let statement = at.until(";")?;
        let is_ours = |token: &&String| token.starts_with("bdpt_");
        if statement[0] == "typedef" {
            typedef(statement, &mut names)?;
        } else if let Some(at) = statement.iter().position(|token| is_ours(&token) && !is_type(token, &names)) {
            if statement.get(at + 1).map(String::as_str) == Some("(") {
                names.functions.insert(statement[at].clone());
            }
        }
    }
    Ok(names)
}

/// What a function returns comes before its name.
fn is_type(token: &str, names: &Names) -> bool {
    names.types.contains(token)
}

fn typedef(statement: &[String], names: &mut Names) -> Result<(), String> {
    let is_ours = |token: &&String| token.starts_with("bdpt_");
    let pointer = statement.windows(2).find(|pair| pair[0] == "*" && is_ours(&&pair[1]));
    if statement.get(1).map(String::as_str) == Some("struct") {
        let name = &statement[2];
        if is_ours(&name) {
            names.types.insert(name.clone());
            if statement.get(3).map(String::as_str) == Some("{") {
                let mut at = Cursor::new(&statement[4..]);
                while at.peek(0) != "}" {
                    fields(name, at.until(";")?, names)?;
                }
            }
        }
    } else if let Some(pair) = pointer {
        // A type of functions: typedef int32_t (*name)(...);
        names.types.insert(pair[1].clone());
    } else if let Some(name) = statement.last().filter(is_ours) {
        names.types.insert(name.clone());
    }
    Ok(())
}

/// The names in one declaration of fields.
fn fields(owner: &str, declaration: &[String], names: &mut Names) -> Result<(), String> {
    let mut add = |name: &str| names.fields.insert(format!("{}.{}", owner, name));
    if let Some(at) = declaration.windows(2).position(|pair| pair[0] == "(" && pair[1] == "*") {
        add(&declaration[at + 2]);
        return Ok(());
    }
    for declarator in declaration.split(|token| token == ",") {
        let end = declarator.iter().position(|token| token == "[").unwrap_or(declarator.len());
        match declarator[..end].last() {
            Some(name) => add(name),
            None => return Err(format!("{}: {:?} is not understood", owner, declaration.join(" "))),
        };
    }
    Ok(())
}
