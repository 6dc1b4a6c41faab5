// SPDX-License-Identifier: Apache-2.0

//! The declarations, read from their text. What is not understood is an error: nothing is left out silently.

use crate::token::{tokens, Cursor};
use std::path::Path;

#[derive(Clone, Debug, PartialEq)]
pub enum Type {
    /// `()`, as what a function returns.
    Nothing,
    Name(String),
    Pointer {
        mutable: bool,
        to: Box<Type>,
    },
    Array {
        of: Box<Type>,
        count: String,
    },
    /// `Option<unsafe extern "C" fn(..) -> ..>`
    Function {
        arguments: Vec<Type>,
        result: Box<Type>,
    },
}

pub struct Struct {
    pub name: String,
    pub fields: Vec<(String, Type)>,
}

pub struct Function {
    pub name: String,
    pub arguments: Vec<Type>,
    pub result: Type,
}

#[derive(Default)]
pub struct Declarations {
    pub opaque: Vec<String>,
    pub structs: Vec<Struct>,
    /// Their `Default` sets struct_size.
    pub sized: Vec<String>,
    pub aliases: Vec<(String, Type)>,
    /// Name, type and value.
    pub constants: Vec<(String, Type, String)>,
    pub functions: Vec<Function>,
}

/// Reads all files of a folder, as one text in the order of their names.
pub fn read_text(folder: &Path) -> String {
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .unwrap_or_else(|error| panic!("{:?}: {}", folder, error))
        .map(|entry| entry.expect("an entry of a folder").path())
        .collect();
    paths.sort();
    paths.iter().map(|path| std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{:?}: {}", path, e))).collect()
}

pub fn parse(text: &str) -> Result<Declarations, String> {
    let tokens = tokens(text);
    let mut at = Cursor::new(&tokens);
    let mut found = Declarations::default();
    let mut has_c_layout = false;
    while !at.is_at_end() {
        if at.take(&["#", "!", "["]) {
            at.until("]")?;
        } else if at.take(&["#", "["]) {
            has_c_layout |= at.until("]")?.concat() == "repr(C)";
        } else if at.take(&["use"]) || at.take(&["mod"]) || at.take(&["pub", "use"]) {
            at.until(";")?;
        } else if at.take(&["macro_rules", "!"]) {
            at.advance();
            at.expect(&["{"])?;
            at.until("}")?;
        } else if at.take(&["opaque", "!", "("]) {
            found.opaque.push(at.advance().to_string());
            at.expect(&[")", ";"])?;
        } else if at.take(&["sized", "!", "("]) {
            found.sized.push(at.advance().to_string());
            at.expect(&[")", ";"])?;
        } else if at.take(&["zeroed", "!", "("]) {
            at.until(")")?;
            at.expect(&[";"])?;
        } else if at.take(&["pub", "struct"]) {
            let name = at.advance().to_string();
            if !std::mem::take(&mut has_c_layout) {
                return Err(format!("{} is not repr(C)", name));
            }
            at.expect(&["{"])?;
            let fields = fields(&mut at)?;
            found.structs.push(Struct { name, fields });
        } else if at.take(&["pub", "type"]) {
            let name = at.advance().to_string();
            at.expect(&["="])?;
            let alias = parse_type(&mut at)?;
            at.expect(&[";"])?;
            found.aliases.push((name, alias));
        } else if at.take(&["pub", "const", "fn"]) {
            at.until("{")?;
            at.until("}")?;
        } else if at.take(&["pub", "const"]) {
            let name = at.advance().to_string();
            at.expect(&[":"])?;
            let kind = parse_type(&mut at)?;
            at.expect(&["="])?;
            found.constants.push((name, kind, at.until(";")?.concat()));
        } else if at.take(&["extern", "\"C\"", "{"]) {
            while !at.take(&["}"]) {
                found.functions.push(function(&mut at)?);
            }
        } else {
            at.expect(&["a declaration"])?;
        }
    }
    Ok(found)
}

fn fields(at: &mut Cursor) -> Result<Vec<(String, Type)>, String> {
    let mut fields = Vec::new();
    while !at.take(&["}"]) {
        at.expect(&["pub"])?;
        let name = at.advance().to_string();
        at.expect(&[":"])?;
        fields.push((name, parse_type(at)?));
        if !at.take(&[","]) && at.peek(0) != "}" {
            at.expect(&[","])?;
        }
    }
    Ok(fields)
}

fn function(at: &mut Cursor) -> Result<Function, String> {
    at.expect(&["pub", "fn"])?;
    let name = at.advance().to_string();
    let (arguments, result) = signature(at)?;
    at.expect(&[";"])?;
    Ok(Function { name, arguments, result })
}

fn signature(at: &mut Cursor) -> Result<(Vec<Type>, Type), String> {
    at.expect(&["("])?;
    let mut arguments = Vec::new();
    while !at.take(&[")"]) {
        at.advance();
        at.expect(&[":"])?;
        arguments.push(parse_type(at)?);
        if !at.take(&[","]) && at.peek(0) != ")" {
            at.expect(&[","])?;
        }
    }
    let result = if at.take(&["-", ">"]) { parse_type(at)? } else { Type::Nothing };
    Ok((arguments, result))
}

fn parse_type(at: &mut Cursor) -> Result<Type, String> {
    if at.take(&["*", "const"]) {
        return Ok(Type::Pointer { mutable: false, to: Box::new(parse_type(at)?) });
    }
    if at.take(&["*", "mut"]) {
        return Ok(Type::Pointer { mutable: true, to: Box::new(parse_type(at)?) });
    }
    if at.take(&["["]) {
        let of = Box::new(parse_type(at)?);
        at.expect(&[";"])?;
        return Ok(Type::Array { of, count: at.until("]")?.concat() });
    }
    if at.take(&["Option", "<", "unsafe", "extern", "\"C\"", "fn"]) {
        let (arguments, result) = signature(at)?;
        at.take(&[","]);
        at.expect(&[">"])?;
        return Ok(Type::Function { arguments, result: Box::new(result) });
    }
    let name = at.advance();
    if name.starts_with(|c: char| c.is_alphabetic()) && at.peek(0) != "<" && at.peek(0) != ":" {
        return Ok(Type::Name(name.to_string()));
    }
    Err(format!("{:?} {:?} is no type of C", name, at.peek(0)))
}
