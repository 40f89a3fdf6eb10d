//! Commands that show a case again, as a shell takes them.

use super::plan::Row;

/// A word for a shell.
pub fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

impl Row {
    /// `hairline explain` of what the arguments name, with this kernel, its epsilons and its contract.
    pub fn explain_command(&self, arguments: &str) -> String {
        let command = format!("hairline explain {arguments} {}", self.entry.selector());
        let mut command = command.trim_end().to_owned();
        if let Some(epsilons) = self.epsilon_argument() {
            command.push_str(&format!(" --epsilon '{epsilons}'"));
        }
        if let Some(contract) = self.contract_name {
            command.push_str(&format!(" --contract {contract}"));
        }
        if let Some(band) = self.contract.band {
            command.push_str(&format!(" --band {band}"));
        }
        command
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quote_in_a_word_stays_one_word() {
        assert_eq!(quoted("a b"), "'a b'");
        assert_eq!(quoted("it's"), "'it'\\''s'");
    }

    #[test]
    fn a_command_names_all_that_a_row_is() {
        let mut row = Row::named("moller-trumbore", Some("parallel=1e-6"), "closed-ray").unwrap();
        let command = row.explain_command("'x'");
        let expected = "hairline explain 'x' --kernel moller-trumbore \
                        --epsilon 'parallel=1e-6,edge=0' --contract closed-ray";
        assert_eq!(command, expected);
        row.contract.band = "4ulps".parse().ok();
        assert_eq!(row.explain_command("'x'"), format!("{expected} --band 4ulps"));
    }
}
